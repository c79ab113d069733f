// SPDX-License-Identifier: Apache-2.0
#include "tests/app/app_fixture.hpp"

#include <stdlib.h>

#include <fstream>
#include <sstream>

namespace sturz::test {
namespace fs = std::filesystem;

App::App() {
  std::string name = (fs::temp_directory_path() / "sturz-app-XXXXXX").string();
  folder_ = mkdtemp(name.data());
  write("scene.yaml", tiny_scene());
}

App::~App() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void App::write(const std::string& name, const std::string& text) const {
  std::ofstream(folder_ / name, std::ios::binary) << text;
}

std::string App::read(const std::string& name) const {
  std::ostringstream text;
  text << std::ifstream(folder_ / name, std::ios::binary).rdbuf();
  return text.str();
}

std::size_t App::n_members(const std::string& results) const {
  std::size_t n = 0;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder_ / results / "members", ignored))
    n += entry.path().extension() == ".nc";
  return n;
}

std::string App::hazard_hash(const std::string& results) const {
  const auto manifest = nlohmann::json::parse(read(results + "/manifest.json"), nullptr, false);
  EXPECT_TRUE(manifest.is_object()) << results << " has no manifest";
  const std::string hash = manifest.is_object() ? manifest.value("hazard_hash", "") : "";
  EXPECT_FALSE(hash.empty()) << results << " has no maps";
  return hash;
}

std::vector<std::string> App::command(const std::vector<std::string>& arguments) const {
  std::vector<std::string> all{STURZ_PROGRAM};
  all.insert(all.end(), arguments.begin(), arguments.end());
  return all;
}

std::vector<std::string> App::environment() const { return {"XDG_CACHE_HOME=" + path("cache")}; }

Ended App::sturz(const std::vector<std::string>& arguments) const {
  return run_process(command(arguments), folder_.string(), environment());
}

std::vector<nlohmann::json> App::events(const Ended& ended) {
  std::vector<nlohmann::json> all;
  std::istringstream lines(ended.out);
  for (std::string line; std::getline(lines, line);) {
    all.push_back(nlohmann::json::parse(line, nullptr, false));
    EXPECT_TRUE(all.back().is_object()) << "not a JSON line: " << line;
  }
  return all;
}

nlohmann::json App::event(const Ended& ended, const std::string& name) {
  for (const auto& e : events(ended))
    if (e.is_object() && e.value("event", "") == name) return e;
  ADD_FAILURE() << "no event '" << name << "' in\n" << ended.out << ended.err;
  return nlohmann::json::object();
}

}  // namespace sturz::test
