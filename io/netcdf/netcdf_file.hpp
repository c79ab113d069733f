// SPDX-License-Identifier: Apache-2.0
/// netCDF-4 files through netCDF-C, with every status checked and one lock for the process.
///
/// Neither netCDF-C nor HDF5 may run in two threads at once, not even on different files. Small
/// files are therefore built in memory under the lock and go to disk as plain bytes
/// (atomic_file.hpp): a full disk is then an ordinary write error. Maps may be larger than memory:
/// their file grows in its part file on disk, one chunk after the other.
#pragma once

#include "io/files/atomic_file.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sturz {

/// The process-wide lock. All other code that calls netCDF, HDF5 or GDAL's drivers on them takes it
/// too.
std::recursive_mutex& netcdf_mutex();

enum class NcType { int32, float32, float64 };

/// Where a file grows before it gets its name.
enum class NetcdfMedium { memory, disk };

/// Builds one file; nothing has its name before commit(). Holds the lock while it lives.
class NetcdfWriter {
 public:
  static constexpr int global = -1;  ///< in place of a variable: the file's own attributes

  explicit NetcdfWriter(std::filesystem::path target, NetcdfMedium medium = NetcdfMedium::memory);
  ~NetcdfWriter();
  NetcdfWriter(const NetcdfWriter&) = delete;
  NetcdfWriter& operator=(const NetcdfWriter&) = delete;

  int dimension(const std::string& name, std::size_t length);
  /// \param dimensions slowest first; none: a scalar
  int variable(const std::string& name, NcType type, const std::vector<int>& dimensions);
  /// Stores the variable in compressed (shuffle, deflate 1), checksummed (fletcher32) chunks.
  /// Whole chunks then go to the file as they come: no more than one is kept in memory.
  void compress(int variable, const std::vector<std::size_t>& chunk);

  void text(int variable, const std::string& name, const std::string& value);
  void number(int variable, const std::string& name, double value);
  void numbers(int variable, const std::string& name, std::span<const double> values);
  void numbers(int variable, const std::string& name, std::span<const float> values);
  void integer(int variable, const std::string& name, std::int64_t value);
  void hash(int variable, const std::string& name, std::uint64_t value);
  void fill_value(int variable, float value);
  void fill_value(int variable, std::int32_t value);

  void put(int variable, std::span<const double> values);
  void put(int variable, std::span<const float> values);
  void put(int variable, std::span<const std::int32_t> values);
  /// A block of `count` values per dimension that begins at `start`.
  void put(int variable, const std::vector<std::size_t>& start,
           const std::vector<std::size_t>& count, std::span<const float> values);
  void put(int variable, const std::vector<std::size_t>& start,
           const std::vector<std::size_t>& count, std::span<const std::int32_t> values);
  void put(int variable, const std::vector<std::size_t>& start,
           const std::vector<std::size_t>& count, std::span<const double> values);

  /// Closes the file, seals what was built in memory (io/files/seal.hpp), and gives it its name in
  /// one stroke. \throws IoError
  void commit();

 private:
  void check(int status, const std::string& what) const;
  void commit_memory();
  void commit_disk();

  std::unique_lock<std::recursive_mutex> lock_;
  std::filesystem::path target_;
  std::unique_ptr<AtomicFile> on_disk_;
  int id_ = -1;
};

/// Reads one file; the lock is taken per call.
class NetcdfReader {
 public:
  /// \throws IoError when the file is missing, cut short or not netCDF
  explicit NetcdfReader(std::filesystem::path file);
  ~NetcdfReader();
  NetcdfReader(const NetcdfReader&) = delete;
  NetcdfReader& operator=(const NetcdfReader&) = delete;

  const std::filesystem::path& file() const { return file_; }
  /// By name where the file was built in memory, else in the order of their definition.
  std::vector<std::string> variables() const;
  bool has(const std::string& variable) const;
  /// Names of a variable's dimensions, slowest first.
  std::vector<std::string> dimensions(const std::string& variable) const;
  /// 0 for a dimension that is not there.
  std::size_t length(const std::string& dimension) const;
  bool is_integer(const std::string& variable) const;
  /// Number of values of a variable. \throws IoError as require_room
  std::size_t size(const std::string& variable) const;
  /// To be asked before memory is taken for what a header promises.
  /// \throws IoError when so many values cannot come out of a file of this length
  void require_room(double n_values, const std::string& what) const;

  /// Names of the attributes; an empty `variable` means the file's own.
  std::vector<std::string> attributes(const std::string& variable) const;
  /// Empty when there is none of this name and kind.
  std::optional<std::string> text(const std::string& variable, const std::string& name) const;
  std::optional<double> number(const std::string& variable, const std::string& name) const;
  /// Empty when there is none of this name, or it is text.
  std::vector<double> numbers(const std::string& variable, const std::string& name) const;
  std::optional<std::int64_t> integer(const std::string& variable, const std::string& name) const;
  std::optional<std::uint64_t> hash(const std::string& variable, const std::string& name) const;

  /// The whole variable. \throws IoError, also for damaged chunks
  std::vector<double> doubles(const std::string& variable) const;
  std::vector<std::int32_t> integers(const std::string& variable) const;
  /// The block of `count` values per dimension that begins at `start`. \throws IoError, also when
  /// the variable has another number of dimensions, or the block is larger than `out`
  void floats(const std::string& variable, const std::vector<std::size_t>& start,
              const std::vector<std::size_t>& count, std::span<float> out) const;

 private:
  int find(const std::string& variable) const;
  std::vector<std::size_t> shape_of(int variable) const;
  void check(int status, const std::string& what) const;

  std::filesystem::path file_;
  int id_ = -1;
};

}  // namespace sturz
