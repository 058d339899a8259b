#include <bit>
#include <cstdint>
#include <ostream>
#include <sstream>

#include "mesh/io/formats.h"
#include "mesh/io/npy.h"
#include "mesh/io/write_file.h"
#include "penumbra/mesh/error.h"
#include "penumbra/render/solids/light_field.h"
#include "render/solids/write_vdb.h"

namespace penumbra {
namespace {

static_assert(std::endian::native == std::endian::little, "fields are written as they lie in memory");

void write_values(std::ostream& out, const LightField& field) {
  out.write(reinterpret_cast<const char*>(field.seen.data()),
            static_cast<std::streamsize>(field.seen.size() * sizeof(float)));
}

void write_npy(std::ostream& out, const LightField& field) {
  const auto count = [&](std::size_t k) { return static_cast<std::size_t>(field.counts[k]); };
  detail::write_npy_header(out, {count(2), count(1), count(0)});
  write_values(out, field);
}

/// VTK's XML image data, values appended as they are.
void write_vti(std::ostream& out, const LightField& field) {
  std::ostringstream extent;
  for (int k = 0; k < 3; ++k)
    extent << (k > 0 ? " " : "") << "0 " << field.counts[static_cast<std::size_t>(k)] - 1;
  out.precision(17);
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" "
         "header_type=\"UInt64\">\n<ImageData WholeExtent=\""
      << extent.str() << "\" Origin=\"" << field.origin.x << " " << field.origin.y << " " << field.origin.z
      << "\" Spacing=\"" << field.step.x << " " << field.step.y << " " << field.step.z
      << "\">\n<Piece Extent=\"" << extent.str()
      << "\">\n<PointData Scalars=\"seen\">\n<DataArray type=\"Float32\" Name=\"seen\" format=\"appended\" "
         "offset=\"0\"/>\n</PointData>\n</Piece>\n</ImageData>\n<AppendedData encoding=\"raw\">\n_";
  const std::uint64_t bytes = field.seen.size() * sizeof(float);
  out.write(reinterpret_cast<const char*>(&bytes), sizeof bytes);
  write_values(out, field);
  out << "\n</AppendedData>\n</VTKFile>\n";
}

using Write = void (*)(std::ostream&, const LightField&);

Write writer_for(const std::filesystem::path& path) {
  const std::string extension = detail::lower_extension(path);
  if (extension == ".vti") return write_vti;
  if (extension == ".npy") return write_npy;
  if (extension == ".vdb") return detail::write_vdb;
  throw UsageError(path.string() +
                   ": fields are written as .vti, .npy or .vdb; choose one of these extensions");
}

}  // namespace

std::vector<std::string_view> light_field_extensions() {
  return {".vti", ".npy", ".vdb"};
}

void require_light_field_format(const std::filesystem::path& path) {
  if (writer_for(path) == detail::write_vdb) detail::require_vdb();
}

void write_light_field(const std::filesystem::path& path, const LightField& field) {
  require_light_field_format(path);
  write_file(path, [&](std::ostream& out) { writer_for(path)(out, field); });
}

}  // namespace penumbra
