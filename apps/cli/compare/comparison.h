// compare: one image's visibility against a reference, which is another image or is traced from the scene.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "penumbra/render/image/error_figures.h"
#include "penumbra/render/image/image.h"
#include "penumbra/render/scene/scene.h"

namespace penumbra::apps {

struct Comparison {
  std::vector<std::uint32_t> judged;    ///< pixels that see a receiver
  std::vector<std::uint32_t> penumbra;  ///< those in true penumbra
  std::vector<float> reference;         ///< mean of both references, one per pixel; where judged
  std::vector<float> first, second;     ///< the references, before the worst pixels were sampled again
  ErrorFigures all, in_penumbra;
  int samples = 0;            ///< rays a pixel of each reference; 0: the reference is an image
  std::size_t skipped = 0;    ///< receivers on which image and scene disagree: at outlines, by rounding
  std::size_t resampled = 0;  ///< worst pixels sampled again before p99 and maximum were stated
  int resamples = 0;          ///< rays of each of those
  /// Certificates of lit and umbra among the judged pixels, and those that a ray in double contradicts. Only
  /// by the oracle, and where the image has certificates.
  std::size_t certified = 0, contradicted = 0;
  std::size_t rays = 0;
  double seconds = 0.0;
};

/// What of the images is judged.
struct Judged {
  std::optional<int> object;  ///< only pixels of this object
  std::string light;          ///< the light's name; empty: the only one
  std::string channel() const { return light.empty() ? "visibility" : "visibility." + light; }
};

/// The reference is taken as free of noise. Throws UsageError where the two do not show the same scene.
Comparison compare_images(const Image& image, const Image& reference, const Judged& judged);

struct TraceOptions {
  int samples = 4'096;  ///< of each of the two references, with seeds of their own
  int threads = 0;
  /// By rays in double without offset (judge.h) in place of Embree's, at so many pixels chosen by chance; 0:
  /// not.
  std::size_t oracle_pixels = 0;
  /// The oracle looks at these pixels instead, ascending, where there are any.
  std::vector<std::uint32_t> pixels{};
  /// Whether the worst pixels are sampled again before p99 and maximum are stated; else the references' noise
  /// is in them.
  bool resample = true;
  /// Nothing is shown of how far it is.
  bool quiet = false;
};

/// Images of one scene, one light and one size against two references. Pixels that one image has asked for
/// are not traced again for the next.
class SceneComparison {
 public:
  /// Refers to the scene. Throws UsageError where the scene has several lights and none is named.
  SceneComparison(const Scene& scene, const Judged& judged, const TraceOptions& options);
  ~SceneComparison();

  /// Throws SceneError where the image was not rendered from this scene, UsageError where it is of another
  /// size than the one before.
  Comparison compare(const Image& image);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace penumbra::apps
