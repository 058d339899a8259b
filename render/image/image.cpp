#include "penumbra/render/image/image.h"

#include "penumbra/mesh/error.h"

namespace penumbra {

std::vector<float>& Image::add(const std::string& name, float value) {
  std::vector<float>& channel = channels[name];
  channel.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), value);
  return channel;
}

const std::vector<float>& Image::at(const std::string& name) const {
  const auto it = channels.find(name);
  if (it == channels.end())
    throw UsageError("the image has no channel \"" + name + "\"; use an EXR written by `penumbra render`");
  return it->second;
}

}  // namespace penumbra
