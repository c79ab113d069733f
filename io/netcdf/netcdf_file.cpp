// SPDX-License-Identifier: Apache-2.0
#include "io/netcdf/netcdf_file.hpp"

#include "engine/core/error.hpp"
#include "io/files/io_error.hpp"
#include "io/files/seal.hpp"

#include <fmt/core.h>
#include <hdf5.h>
#include <netcdf.h>
#include <netcdf_mem.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <memory>

namespace sturz {
namespace {

nc_type code(NcType type) {
  switch (type) {
    case NcType::int32:
      return NC_INT;
    case NcType::float32:
      return NC_FLOAT;
    case NcType::float64:
      return NC_DOUBLE;
  }
  return NC_NAT;
}

}  // namespace

std::recursive_mutex& netcdf_mutex() {
  static std::recursive_mutex mutex;
  // Every file is closed by its owner; what HDF5 would do at exit with one that a full disk kept
  // open is to complain or to hang. It must be told before anything else.
  static const bool told = H5dont_atexit() >= 0;
  static_cast<void>(told);
  // HDF5 prints its errors thread by thread, and netCDF silences only the thread in which it woke
  // up; it asks HDF5 for optional attributes all the time, and each one that is absent is an error.
  thread_local bool silent = false;
  if (!silent) {
    const std::lock_guard guard(mutex);
    silent = H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr) >= 0;
  }
  return mutex;
}

NetcdfWriter::NetcdfWriter(std::filesystem::path target, NetcdfMedium medium)
    : lock_(netcdf_mutex()), target_(std::move(target)) {
  if (medium == NetcdfMedium::disk) {
    on_disk_ = std::make_unique<AtomicFile>(target_);
    check(nc_create(on_disk_->part().c_str(), NC_NETCDF4 | NC_CLOBBER, &id_), "creating the file");
  } else {
    constexpr std::size_t first_guess = std::size_t{1} << 20;
    check(nc_create_mem(target_.c_str(), NC_NETCDF4, first_guess, &id_), "creating the file");
  }
}

NetcdfWriter::~NetcdfWriter() {
  if (id_ < 0) return;
  // A full disk: HDF5 wants to write its last blocks before it lets go. Give it the room.
  if (on_disk_) static_cast<void>(::truncate(on_disk_->part().c_str(), 0));
  nc_abort(id_);
}

void NetcdfWriter::check(int status, const std::string& what) const {
  if (status == NC_NOERR) return;
  if (on_disk_) on_disk_->fail("cannot write", errno);
  throw IoError(fmt::format("{}: {} failed (netCDF: {}). Is there enough memory?", target_.string(),
                            what, nc_strerror(status)));
}

int NetcdfWriter::dimension(const std::string& name, std::size_t length) {
  int dimension = -1;
  check(nc_def_dim(id_, name.c_str(), length, &dimension), "defining dimension " + name);
  return dimension;
}

int NetcdfWriter::variable(const std::string& name, NcType type,
                           const std::vector<int>& dimensions) {
  int variable = -1;
  check(nc_def_var(id_, name.c_str(), code(type), static_cast<int>(dimensions.size()),
                   dimensions.data(), &variable),
        "defining variable " + name);
  return variable;
}

void NetcdfWriter::compress(int variable, const std::vector<std::size_t>& chunk) {
  check(nc_def_var_chunking(id_, variable, NC_CHUNKED, chunk.data()), "chunking");
  check(nc_def_var_deflate(id_, variable, /*shuffle=*/1, /*deflate=*/1, /*level=*/1),
        "compressing");
  check(nc_def_var_fletcher32(id_, variable, NC_FLETCHER32), "adding checksums");
  std::size_t bytes = sizeof(double);
  for (const std::size_t length : chunk) bytes *= length;
  constexpr float keep_none = 1;  // what is written whole may go first
  if (on_disk_) check(nc_set_var_chunk_cache(id_, variable, bytes, 7, keep_none), "caching");
}

void NetcdfWriter::text(int variable, const std::string& name, const std::string& value) {
  check(nc_put_att_text(id_, variable, name.c_str(), value.size(), value.data()),
        "writing attribute " + name);
}

void NetcdfWriter::number(int variable, const std::string& name, double value) {
  numbers(variable, name, {&value, 1});
}

void NetcdfWriter::numbers(int variable, const std::string& name, std::span<const double> values) {
  check(nc_put_att_double(id_, variable, name.c_str(), NC_DOUBLE, values.size(), values.data()),
        "writing attribute " + name);
}

void NetcdfWriter::numbers(int variable, const std::string& name, std::span<const float> values) {
  check(nc_put_att_float(id_, variable, name.c_str(), NC_FLOAT, values.size(), values.data()),
        "writing attribute " + name);
}

void NetcdfWriter::integer(int variable, const std::string& name, std::int64_t value) {
  const long long wide = value;
  check(nc_put_att_longlong(id_, variable, name.c_str(), NC_INT64, 1, &wide),
        "writing attribute " + name);
}

void NetcdfWriter::hash(int variable, const std::string& name, std::uint64_t value) {
  const unsigned long long wide = value;
  check(nc_put_att_ulonglong(id_, variable, name.c_str(), NC_UINT64, 1, &wide),
        "writing attribute " + name);
}

void NetcdfWriter::fill_value(int variable, float value) {
  check(nc_def_var_fill(id_, variable, NC_FILL, &value), "setting the fill value");
}

void NetcdfWriter::fill_value(int variable, std::int32_t value) {
  check(nc_def_var_fill(id_, variable, NC_FILL, &value), "setting the fill value");
}

void NetcdfWriter::put(int variable, std::span<const double> values) {
  check(nc_put_var_double(id_, variable, values.data()), "writing values");
}

void NetcdfWriter::put(int variable, std::span<const float> values) {
  check(nc_put_var_float(id_, variable, values.data()), "writing values");
}

void NetcdfWriter::put(int variable, std::span<const std::int32_t> values) {
  check(nc_put_var_int(id_, variable, values.data()), "writing values");
}

void NetcdfWriter::put(int variable, const std::vector<std::size_t>& start,
                       const std::vector<std::size_t>& count, std::span<const float> values) {
  check(nc_put_vara_float(id_, variable, start.data(), count.data(), values.data()),
        "writing values");
}

void NetcdfWriter::put(int variable, const std::vector<std::size_t>& start,
                       const std::vector<std::size_t>& count,
                       std::span<const std::int32_t> values) {
  check(nc_put_vara_int(id_, variable, start.data(), count.data(), values.data()),
        "writing values");
}

void NetcdfWriter::put(int variable, const std::vector<std::size_t>& start,
                       const std::vector<std::size_t>& count, std::span<const double> values) {
  check(nc_put_vara_double(id_, variable, start.data(), count.data(), values.data()),
        "writing values");
}

void NetcdfWriter::commit() {
  expect(id_ >= 0, "a file is committed once");
  if (on_disk_) {
    commit_disk();
  } else {
    commit_memory();
  }
}

void NetcdfWriter::commit_disk() {
  errno = 0;
  check(nc_close(id_), "closing the file");
  id_ = -1;
  lock_.unlock();
  on_disk_->commit();
}

void NetcdfWriter::commit_memory() {
  NC_memio image{};
  const int status = nc_close_memio(id_, &image);
  id_ = -1;
  const std::unique_ptr<void, decltype(&std::free)> memory(image.memory, &std::free);
  lock_.unlock();  // the disk may take its time; other threads may build their files meanwhile
  check(status, "closing the file");
  const std::span content(static_cast<const std::byte*>(memory.get()), image.size);
  const std::string seal = seal_of(content);
  AtomicFile file(target_);
  file.write(content);
  file.write(std::as_bytes(std::span(seal)));
  file.commit();
}

}  // namespace sturz
