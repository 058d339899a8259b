// NumPy's files of arrays (.npy, format 1.0 and 2.0): written from any numbers, read as rows of doubles.
#pragma once

#include <cstddef>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace penumbra::detail {

/// The header of an array of little-endian float32 in C order; the values follow as they lie in memory.
void write_npy_header(std::ostream& out, const std::vector<std::size_t>& shape);

/// An array of two dimensions, row after row.
struct NpyRows {
  std::size_t rows = 0, columns = 0;
  std::vector<double> values;
};
/// Of float32 or float64 of either byte order, in C or Fortran order. Throws MeshError for other files, and
/// where the file is shorter than its shape says; `advice` ends its message.
NpyRows read_npy_rows(
    const std::filesystem::path& path,
    const char* advice = "save it by numpy.save as an array of float32 or float64 of two dimensions");

}  // namespace penumbra::detail
