#include "penumbra/render/image/image.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "penumbra/mesh/error.h"

namespace penumbra {
namespace {

namespace fs = std::filesystem;

class ImageTest : public testing::Test {
 protected:
  ImageTest() : folder_(fs::temp_directory_path() / ("penumbra-image-" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~ImageTest() override { fs::remove_all(folder_); }
  fs::path path(const char* name) const { return folder_ / name; }
  fs::path folder_;
};

Image sample_image() {
  Image image{.width = 5, .height = 3, .channels = {}};
  for (const char* name : {"R", "G", "B", "A", "visibility", "P.X"}) {
    std::vector<float>& channel = image.add(name);
    for (std::size_t i = 0; i < channel.size(); ++i)
      channel[i] = 0.1f * static_cast<float>(i) + static_cast<float>(image.channels.size());
  }
  image.channels["P.X"][4] = std::numeric_limits<float>::denorm_min();
  image.channels["P.X"][5] = -3.402823e38f;
  return image;
}

std::string bytes_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

TEST_F(ImageTest, ExrKeepsEveryBit) {
  const Image image = sample_image();
  write_exr(path("a.exr"), image);
  const Image again = read_exr(path("a.exr"));
  EXPECT_EQ(again.width, 5);
  EXPECT_EQ(again.height, 3);
  EXPECT_EQ(again.channels, image.channels);
}

TEST_F(ImageTest, NamesThatAnExrWouldCutAreRefused) {
  Image image = sample_image();
  image.channels["visibility." + std::string(300, 'a')] = image.channels.at("visibility");
  EXPECT_THROW(write_exr(path("long.exr"), image), SystemError);
}

TEST_F(ImageTest, ExrIsTheSameFileEveryTime) {
  write_exr(path("a.exr"), sample_image());
  write_exr(path("b.exr"), sample_image());
  EXPECT_EQ(bytes_of(path("a.exr")), bytes_of(path("b.exr")));
}

TEST_F(ImageTest, EveryTruncationIsRefusedOrRead) {
  write_exr(path("a.exr"), sample_image());
  const std::string whole = bytes_of(path("a.exr"));
  for (std::size_t size = 0; size < whole.size(); ++size) {
    std::ofstream(path("t.exr"), std::ios::binary) << whole.substr(0, size);
    EXPECT_THROW(read_exr(path("t.exr")), UsageError) << size << " of " << whole.size() << " bytes";
  }
}

TEST_F(ImageTest, FlippedBytesNeverCrash) {
  write_exr(path("a.exr"), sample_image());
  const std::string whole = bytes_of(path("a.exr"));
  for (std::size_t at = 0; at < whole.size(); ++at)
    for (const int flip : {0x01, 0x80, 0xff}) {
      std::string damaged = whole;
      damaged[at] = static_cast<char>(damaged[at] ^ flip);
      std::ofstream(path("d.exr"), std::ios::binary) << damaged;
      try {
        read_exr(path("d.exr"));
      } catch (const UsageError&) {
      }
    }
}

TEST_F(ImageTest, WhatIsNoExrIsRefusedByName) {
  std::ofstream(path("text.exr")) << "hello";
  for (const fs::path& bad : {path("missing.exr"), path("text.exr"), folder_}) {
    try {
      read_exr(bad);
      FAIL() << bad;
    } catch (const UsageError& e) {
      EXPECT_NE(std::string(e.what()).find(bad.string()), std::string::npos) << e.what();
    }
  }
}

TEST_F(ImageTest, MissingChannelIsNamed) {
  try {
    sample_image().at("depth");
    FAIL();
  } catch (const UsageError& e) {
    EXPECT_NE(std::string(e.what()).find("depth"), std::string::npos);
  }
}

TEST_F(ImageTest, UnwritableFolderThrowsAndLeavesNothing) {
  EXPECT_THROW(write_exr(path("no/a.exr"), sample_image()), SystemError);
  EXPECT_THROW(write_png(path("no/a.png"), sample_image()), SystemError);
  EXPECT_TRUE(fs::is_empty(folder_));
}

Image one_pixel(float r, float g, float b, float a) {
  Image image{.width = 1, .height = 1, .channels = {}};
  image.add("R", r);
  image.add("G", g);
  image.add("B", b);
  image.add("A", a);
  return image;
}

using Bytes = std::vector<unsigned char>;

TEST(Srgb, KnownValues) {
  // IEC 61966-2-1: linear 0.5 is 187.5, linear 0.0031308 is 10.3 of 255.
  EXPECT_EQ(encode_srgb(one_pixel(0.0f, 0.5f, 1.0f, 1.0f)), (Bytes{0, 188, 255}));
  EXPECT_EQ(encode_srgb(one_pixel(0.0031308f, 0.2158605f, 7.0f, 1.0f)), (Bytes{10, 128, 255}));
}

TEST(Srgb, ExposureIsInStops) {
  EXPECT_EQ(encode_srgb(one_pixel(0.25f, 1.0f, 0.0f, 1.0f), 1.0), (Bytes{188, 255, 0}));
  EXPECT_EQ(encode_srgb(one_pixel(1.0f, 1.0f, 1.0f, 1.0f), -1.0), (Bytes{188, 188, 188}));
}

TEST(Srgb, NotANumberAndNegativeAreBlack) {
  EXPECT_EQ(encode_srgb(one_pixel(std::nanf(""), -1.0f, -0.0f, 1.0f)), (Bytes{0, 0, 0}));
}

TEST(Srgb, NothingSeenIsLightGray) {
  EXPECT_EQ(encode_srgb(one_pixel(1.0f, 0.0f, 0.0f, 0.0f)), (Bytes{230, 230, 230}));
}

Bytes over(const Image& image, const char* background) {
  return encode_srgb(image, Display{.background = parse_background(background)});
}

TEST(Srgb, BackgroundsShowThroughByAlpha) {
  EXPECT_EQ(over(one_pixel(0.0f, 0.0f, 0.0f, 0.0f), "#0a80ff"), (Bytes{10, 128, 255}));
  EXPECT_EQ(over(one_pixel(0.0f, 0.5f, 1.0f, 1.0f), "#0a80ff"), (Bytes{0, 188, 255}));
  // Black that covers 3/4 of white leaves 1/4 of linear light, 0.25 being 137 of sRGB; green covers as much.
  EXPECT_EQ(over(one_pixel(0.0f, 0.75f, 0.0f, 0.75f), "white"), (Bytes{137, 255, 137}));
  EXPECT_EQ(over(one_pixel(0.0f, 0.25f, 0.0f, 0.75f), "black"), (Bytes{0, 137, 0}));
}

// What is brighter than white covers no more of the background than its alpha says.
TEST(Srgb, WhatIsSeenIsClippedBeforeItIsBlended) {
  EXPECT_EQ(over(one_pixel(9.0f, 9.0f, 9.0f, 0.25f), "black"), (Bytes{137, 137, 137}));
  EXPECT_EQ(encode_srgb(one_pixel(1.0f, 1.0f, 1.0f, 0.25f),
                        Display{.exposure_stops = 5.0, .background = parse_background("black")}),
            (Bytes{137, 137, 137}));
}

TEST(Srgb, TransparentBackgroundsLeaveAlpha) {
  EXPECT_EQ(over(one_pixel(0.0f, 0.0f, 0.0f, 0.0f), "transparent"), (Bytes{0, 0, 0, 0}));
  EXPECT_EQ(over(one_pixel(0.0f, 0.5f, 1.0f, 1.0f), "transparent"), (Bytes{0, 188, 255, 255}));
  EXPECT_EQ(over(one_pixel(0.0f, 0.1f, 0.2f, 0.2f), "transparent"), (Bytes{0, 188, 255, 51}))
      << "colors are not multiplied by it";
}

TEST_F(ImageTest, PngHasAlphaWhereTheBackgroundIsTransparent) {
  write_png(path("a.png"), sample_image(), {.background = parse_background("transparent")});
  write_png(path("b.png"), sample_image());
  constexpr std::size_t kColorType = 25;
  EXPECT_EQ(bytes_of(path("a.png"))[kColorType], 6) << "RGB with alpha";
  EXPECT_EQ(bytes_of(path("b.png"))[kColorType], 2) << "RGB";
}

TEST_F(ImageTest, PngHasItsSignatureAndSize) {
  write_png(path("a.png"), sample_image());
  const std::string png = bytes_of(path("a.png"));
  ASSERT_GT(png.size(), 24u);
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(png[19], 5);
  EXPECT_EQ(png[23], 3);
}

}  // namespace
}  // namespace penumbra
