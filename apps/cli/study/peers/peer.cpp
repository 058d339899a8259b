#include "apps/cli/study/peers/peer.h"

#include <algorithm>

#include "apps/cli/study/peers/cycles.h"
#include "apps/cli/study/peers/povray.h"
#include "apps/cli/study/peers/threejs.h"

namespace penumbra::apps {

std::vector<Peer> all_peers(const std::filesystem::path& three) {
  return {povray_peer(), cycles_peer(), threejs_peer(three)};
}

bool takes(const Peer& peer, const LightShape& light) {
  return std::holds_alternative<DiskLight>(light) ||
         (peer.takes_distant && std::holds_alternative<DistantLight>(light));
}

std::vector<float> visibility_of_ratio(std::span<const float> shadowed, std::span<const float> unshadowed,
                                       std::span<const float> horizon) {
  std::vector<float> out(shadowed.size(), 0.0f);
  for (std::size_t i = 0; i < out.size(); ++i)
    if (unshadowed[i] > 0.0f) out[i] = horizon[i] * std::min(1.0f, shadowed[i] / unshadowed[i]);
  return out;
}

Measured peer_result(const PeerCase& given, std::vector<float> visibility, std::vector<double> frames,
                     const std::string& stage, const std::string& renderer) {
  Measured out;
  const std::vector<float>& alpha = given.unshadowed.at("A");
  for (std::size_t i = 0; i < alpha.size(); ++i)
    if (alpha[i] == 0.0f) visibility[i] = 1.0f;
  out.frames = std::move(frames);
  out.stages = {{stage, quartiles_of(out.frames).median}};
  out.image = given.unshadowed;
  out.image.channels["visibility"] = visibility;
  out.visibility = std::move(visibility);
  out.renderer = renderer;
  return out;
}

}  // namespace penumbra::apps
