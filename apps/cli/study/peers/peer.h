// study --peers: what people use instead, on the same pixels. Each peer is another program, which may be
// missing or fail: then it has no rows, and the study goes on.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "apps/cli/study/measure/measure.h"
#include "penumbra/mesh/error.h"

namespace penumbra::apps {

/// Another program that did not do what it should.
class PeerError : public Error {
 public:
  using Error::Error;
};

struct PeerCase {
  const StudyCase& seen;
  /// A picture of the case without shadows: `visibility` is what the horizon leaves of the light.
  const Image& unshadowed;
  int rounds = 5;
  int threads = 1;
};

struct Peer {
  std::string name;
  std::vector<Setting> settings;
  /// Why it cannot be run here; empty: it can.
  std::function<std::string()> missing;
  bool takes_distant = false;
  /// One result for each setting. Throws PeerError, or what files throw.
  std::function<std::vector<Measured>(const PeerCase&, std::span<const Setting>)> measure;
};

/// All of them that are other programs (embree_loop.h is a method of this one). `three`: see threejs.h.
std::vector<Peer> all_peers(const std::filesystem::path& three = {});

/// Whether it has lights of this kind. None has rectangles.
bool takes(const Peer& peer, const LightShape& light);

/// Shadowed over unshadowed, one a pixel, at most 1, times what the horizon leaves of the light; 0 where the
/// unshadowed picture is dark. All of one size.
std::vector<float> visibility_of_ratio(std::span<const float> shadowed, std::span<const float> unshadowed,
                                       std::span<const float> horizon);

/// What a row needs: the case's picture with that visibility where there is a surface. `stage` is the name of
/// its times.
Measured peer_result(const PeerCase& given, std::vector<float> visibility, std::vector<double> frames,
                     const std::string& stage, const std::string& renderer);

}  // namespace penumbra::apps
