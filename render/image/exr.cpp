// EXR by OpenEXR, through memory: files are then written whole or not at all, and read without trusting their
// header.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <new>
#include <string_view>

#include "mesh/io/write_file.h"
#include "penumbra/mesh/error.h"
#include "penumbra/render/image/image.h"

namespace penumbra {
namespace {

constexpr int kMaxSide = 65'536;
constexpr std::size_t kMaxPixels = std::size_t{1} << 28;  // 16,384²
// No codec of EXR packs more tightly; a header that promises more than this per byte of file is damaged.
constexpr std::size_t kMaxPacking = 4'096;

class MemoryOut : public Imf::OStream {
 public:
  MemoryOut() : Imf::OStream("memory") {}
  void write(const char c[], int n) override {
    const std::size_t end = position_ + static_cast<std::size_t>(n);
    if (end > bytes.size()) bytes.resize(end);
    std::memcpy(bytes.data() + position_, c, static_cast<std::size_t>(n));
    position_ = end;
  }
  uint64_t tellp() override { return position_; }
  void seekp(uint64_t pos) override { position_ = pos; }

  std::string bytes;

 private:
  std::size_t position_ = 0;
};

class MemoryIn : public Imf::IStream {
 public:
  explicit MemoryIn(const std::string& bytes) : Imf::IStream("memory"), bytes_(bytes) {}
  bool read(char c[], int n) override {
    const auto count = static_cast<std::size_t>(n);
    if (position_ > bytes_.size() || bytes_.size() - position_ < count)
      throw UsageError("ends too early; it is truncated");
    std::memcpy(c, bytes_.data() + position_, count);
    position_ += count;
    return position_ < bytes_.size();
  }
  uint64_t tellg() override { return position_; }
  void seekg(uint64_t pos) override { position_ = pos; }

 private:
  const std::string& bytes_;
  std::size_t position_ = 0;
};

std::string encode(const Image& image) {
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const auto& [name, text] : image.metadata) header.insert(name, Imf::StringAttribute(text));
  Imf::FrameBuffer frame;
  for (const auto& [name, values] : image.channels) {
    if (name.size() > 255)
      throw UsageError("channel " + name.substr(0, 40) + "...: its name has more than 255 letters");
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    // OpenEXR's slices are not const, but writing only reads them.
    char* base = reinterpret_cast<char*>(const_cast<float*>(values.data()));
    frame.insert(name, Imf::Slice(Imf::FLOAT, base, sizeof(float),
                                  sizeof(float) * static_cast<std::size_t>(image.width)));
  }
  MemoryOut out;
  {
    Imf::OutputFile file(out, header);
    file.setFrameBuffer(frame);
    file.writePixels(image.height);
  }
  return std::move(out.bytes);
}

Image empty_image(const Imf::Header& header, std::size_t file_bytes) {
  const Imath::Box2i window = header.dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide)
    throw UsageError("has an impossible size");
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  std::size_t channels = 0;
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
    if (it.channel().xSampling != 1 || it.channel().ySampling != 1)
      throw UsageError("has subsampled channels");
    ++channels;
  }
  if (pixels > kMaxPixels || pixels * channels / kMaxPacking > file_bytes)
    throw UsageError("promises more pixels than it can hold");
  Image image{
      .width = static_cast<int>(width), .height = static_cast<int>(height), .channels = {}, .metadata = {}};
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it) image.add(it.name());
  return image;
}

Image decode(const std::string& bytes) {
  MemoryIn in(bytes);
  Imf::InputFile file(in);
  Image image = empty_image(file.header(), bytes.size());
  const Imath::Box2i window = file.header().dataWindow();
  for (auto it = file.header().begin(); it != file.header().end(); ++it)
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&it.attribute());
        text != nullptr && std::string_view(it.name()).starts_with("penumbra"))
      image.metadata[it.name()] = text->value();
  Imf::FrameBuffer frame;
  for (auto& [name, values] : image.channels)
    frame.insert(name, Imf::Slice::Make(Imf::FLOAT, values.data(), window));
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
  return image;
}

}  // namespace

void write_exr(const std::filesystem::path& path, const Image& image) {
  std::string bytes;
  try {
    bytes = encode(image);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    throw SystemError(path.string() + ": cannot be encoded as EXR: " + e.what());
  }
  write_file(path, [&bytes](std::ostream& out) {
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  });
}

Image read_exr(const std::filesystem::path& path) {
  const auto fail = [&path](const std::string& reason) -> UsageError {
    return UsageError(path.string() + ": " + reason + "; give an EXR written by `penumbra render`");
  };
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) throw fail("no such file");
  if (!std::filesystem::is_regular_file(path, ignored)) throw fail("is no regular file");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw fail("cannot be opened");
  const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  try {
    return decode(bytes);
  } catch (const UsageError& e) {
    throw fail(e.what());
  } catch (const std::bad_alloc&) {  // the header promises no more than such a file can hold
    throw;
  } catch (const std::exception& e) {  // OpenEXR's own
    throw fail(std::string("is no readable EXR (") + e.what() + ")");
  }
}

}  // namespace penumbra
