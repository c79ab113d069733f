// SPDX-License-Identifier: Apache-2.0
#include "io/gdal/input_trust.hpp"

#include "engine/core/error.hpp"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_http.h>
#include <cpl_minixml.h>
#include <cpl_vsi.h>
#include <cpl_vsi_virtual.h>
#include <fmt/core.h>
#include <gdal_priv.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

namespace sturz {
namespace {

std::atomic<bool> remote_allowed{false};

constexpr std::array network_systems{"vsicurl", "vsis3",    "vsigs",   "vsiaz",     "vsiadls",
                                     "vsioss",  "vsiswift", "vsihdfs", "vsiwebhdfs"};

/// Drivers whose data lie behind a server or a database, as GDAL names them.
constexpr std::array network_drivers{
    "WMS",      "WMTS",      "WCS",     "WFS",      "OAPIF",        "OGCAPI",        "HTTP",
    "PLMOSAIC", "PLSCENES",  "NGW",     "EEDA",     "EEDAI",        "DAAS",          "STACTA",
    "STACIT",   "Carto",     "CouchDB", "Cloudant", "AmigoCloud",   "Elasticsearch", "GMLAS",
    "CSW",      "DODS",      "JPIPKAK", "RDA",      "PostgreSQL",   "PostGISRaster", "MySQL",
    "OCI",      "GeoRaster", "ODBC",    "HANA",     "MSSQLSpatial", "MongoDBv3",     "GNMDatabase"};

constexpr int deepest_nesting = 16;
constexpr std::size_t largest_virtual_file = 64U << 20;

bool holds(const std::string& text, std::string_view what) {
  return std::search(text.begin(), text.end(), what.begin(), what.end(), [](char a, char b) {
           return std::tolower(static_cast<unsigned char>(a)) == b;
         }) != text.end();
}

/// Systems anywhere in the name ("/vsizip//vsicurl/...", "NETCDF:https://..."), servers at its
/// start.
bool is_remote(const std::string& name) {
  for (const char* system : network_systems)
    if (holds(name, std::string("/") + system)) return true;
  for (const char* server : {"pg:", "postgresql:", "mysql:", "mssql:", "oci:", "odbc:", "wfs:",
                             "wms:", "wcs:", "wmts:", "oapif:", "dods:", "es:", "csw:"})
    if (holds(name.substr(0, std::string_view(server).size()), server)) return true;
  return holds(name, "://");
}

/// A file of the library that cannot be opened, whatever its name.
class ClosedSystem : public VSIFilesystemHandler {
 public:
  VSIVirtualHandle* Open(const char* name, const char*, bool, CSLConstList) override {
    return refused(name), nullptr;
  }
  int Stat(const char* name, VSIStatBufL*, int) override { return refused(name), -1; }

 private:
  static void refused(const char* name) {
    CPLError(CE_Failure, CPLE_OpenFailed, "%s lies on the network, which is not read", name);
  }
};

CPLHTTPResult* no_request(const char* url, CSLConstList, GDALProgressFunc, void*,
                          CPLHTTPFetchWriteFunc, void*, void*) {
  CPLError(CE_Failure, CPLE_OpenFailed, "%s lies on the network, which is not read", url);
  auto* result = static_cast<CPLHTTPResult*>(CPLCalloc(1, sizeof(CPLHTTPResult)));
  result->nStatus = 1;
  result->pszErrBuf = CPLStrdup("the network is not read");
  return result;
}

/// The start of a virtual file, or of the text that stands for one; empty for any other file.
std::string virtual_text(const std::string& name) {
  if (name.find('<') != std::string::npos) return name;
  const std::unique_ptr<VSILFILE, int (*)(VSILFILE*)> file(VSIFOpenL(name.c_str(), "rb"),
                                                           &VSIFCloseL);
  if (!file) return {};
  std::string text(4096, '\0');
  text.resize(VSIFReadL(text.data(), 1, text.size(), file.get()));
  if (text.find("<VRTDataset") == std::string::npos &&
      text.find("<OGRVRTDataSource") == std::string::npos)
    return {};
  while (text.size() < largest_virtual_file) {
    const std::size_t before = text.size();
    text.resize(before + (1U << 16));
    text.resize(before + VSIFReadL(text.data() + before, 1, 1U << 16, file.get()));
    if (text.size() == before) break;
  }
  return text;
}

struct Search {
  const std::string& label;
  int depth = 0;
};

void search_file(const std::string& name, const Search& search);

/// "... = chain.vrt: names the source 'x', which ..."
[[noreturn]] void refuse_source(const Search& search, const std::string& why) {
  throw SetupError(
      fmt::format("{}: {}. Copy the data beside the scenario, or call sturz with "
                  "--allow-remote-inputs if you trust the scenario.",
                  search.label, why));
}

void search_node(const CPLXMLNode* node, const std::string& folder, const Search& search) {
  for (; node != nullptr; node = node->psNext) {
    if (node->eType != CXT_Element) continue;
    const std::string_view element = node->pszValue;
    if (element == "VRTRasterBand" &&
        std::string_view(CPLGetXMLValue(node, "subClass", "")) == "VRTRawRasterBand")
      refuse_source(search, fmt::format("takes the bytes of {} for values (a raw virtual raster)",
                                        CPLGetXMLValue(node, "SourceFilename", "another file")));
    if (element == "SourceFilename" || element == "SourceDataset" || element == "SrcDataSource") {
      const std::string source = CPLGetXMLValue(node, "", "");
      const std::string relative =
          CPLGetXMLValue(node, "relativeToVRT", CPLGetXMLValue(node, "relativetoVRT", "0"));
      const bool beside = relative == "1" && source.find('<') == std::string::npos;
      search_file(beside ? CPLProjectRelativeFilename(folder.c_str(), source.c_str()) : source,
                  search);
    }
    search_node(node->psChild, folder, search);
  }
}

void search_file(const std::string& name, const Search& search) {
  constexpr std::string_view view = "vrt://";  // a local file, seen in another way
  if (name.starts_with(view)) {
    const std::size_t end = std::min(name.find('?'), name.size());
    return search_file(name.substr(view.size(), end - view.size()), search);
  }
  if (is_remote(name))
    refuse_source(search, fmt::format("'{}' lies on the network (a scenario may not fetch by "
                                      "itself)",
                                      name.substr(0, 200)));
  if (search.depth >= deepest_nesting) return;  // the library gives up far earlier
  const std::string text = virtual_text(name);
  if (text.empty()) return;
  const std::unique_ptr<CPLXMLNode, void (*)(CPLXMLNode*)> tree(CPLParseXMLString(text.c_str()),
                                                                &CPLDestroyXMLNode);
  const std::string folder = CPLGetPath(name.c_str());
  search_node(tree.get(), folder, {search.label, search.depth + 1});
}

}  // namespace

void allow_remote_inputs() { remote_allowed = true; }

void require_trusted(const InputFile& file) {
  if (remote_allowed) return;
  search_file(file.path, {file.label, 0});
}

void close_network() {
  if (remote_allowed) return;
  std::string gone;
  for (const char* name : network_drivers) {
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(name);
    if (driver == nullptr) continue;
    GetGDALDriverManager()->DeregisterDriver(driver);
    delete driver;
    gone += std::string(gone.empty() ? "" : ",") + name;
  }
  // For a later call that registers all drivers again.
  std::string skipped = CPLGetConfigOption("GDAL_SKIP", "");
  if (skipped.find(',') == std::string::npos)
    std::replace(skipped.begin(), skipped.end(), ' ', ',');
  CPLSetConfigOption("GDAL_SKIP", (skipped.empty() ? gone : skipped + "," + gone).c_str());
  // The library keeps ours to its end and forgets the one before, which others may still use.
  static auto* const replaced = new std::vector<VSIFilesystemHandler*>;
  for (const char* system : network_systems)
    for (const char* kind : {"", "_streaming"}) {
      const std::string prefix = fmt::format("/{}{}/", system, kind);
      replaced->push_back(VSIFileManager::GetHandler(prefix.c_str()));
      VSIFileManager::InstallHandler(prefix, new ClosedSystem);
    }
  CPLHTTPSetFetchCallback(no_request, nullptr);
}

}  // namespace sturz
