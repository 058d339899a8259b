// What the viewer shows: a scene, its light and camera as they are now, and how they are looked at.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "apps/viewer/handles/handled_light.h"
#include "penumbra/render/renderer.h"

namespace penumbra::viewer {

enum class Arrangement { kSingle, kSplit, kDifference };

/// What of the picture is shown.
enum class Shown {
  kPicture,     ///< colors
  kVisibility,  ///< the fraction of the disk, black to white
  kRegion,      ///< what is certified: yellow lit, orange partial, blue umbra; gray nothing
};

/// Across what sheets and volumes are cut.
enum class CutAxis { kLight, kX, kY, kZ };

/// Limits of Overlays::detail.
inline constexpr double kFinest = 0.003, kCoarsest = 0.1;

/// What is drawn over the picture.
struct Overlays {
  bool light = true;         ///< the light's disk and handles
  bool faces = false;        ///< casters' faces by class
  bool silhouettes = false;  ///< penumbra and umbra silhouettes
  bool band = false;         ///< every edge that may be a silhouette
  bool sheets = false;       ///< facets and cone patches of both boundaries
  bool penumbra = false;     ///< the volume as the sum of its cells
  bool umbra = false;        ///< the volume as the sum of its cells
  bool penumbra_solid = false;
  bool umbra_solid = false;
  bool textures = false;  ///< what the D-buffer or the occlusion textures hold
  /// Detail to which solids are refined, in parts of the casters' diagonal.
  double detail = 0.02;
  /// Sheets, volumes and solids are drawn up to this part of the way: from the light's plane, or from the
  /// scene's first point where the light is far away, to the scene's far end; or along an axis, half way
  /// through the middle of the casters.
  double cut = 1.0;
  CutAxis cut_axis = CutAxis::kLight;
  bool solids() const { return penumbra_solid || umbra_solid; }
  /// What `cut` cuts.
  bool can_be_cut() const { return sheets || penumbra || umbra || solids(); }
  bool geometry() const { return faces || silhouettes || band || can_be_cut(); }
  bool operator==(const Overlays&) const = default;
};

/// Their names in files, on the command line and in --status.
inline constexpr std::array kOverlayFlags{std::pair("light", &Overlays::light),
                                          std::pair("faces", &Overlays::faces),
                                          std::pair("silhouettes", &Overlays::silhouettes),
                                          std::pair("band", &Overlays::band),
                                          std::pair("sheets", &Overlays::sheets),
                                          std::pair("penumbra", &Overlays::penumbra),
                                          std::pair("umbra", &Overlays::umbra),
                                          std::pair("penumbra-solid", &Overlays::penumbra_solid),
                                          std::pair("umbra-solid", &Overlays::umbra_solid),
                                          std::pair("textures", &Overlays::textures)};

struct State {
  std::filesystem::path path;          ///< the scene or mesh it was loaded from
  std::shared_ptr<const Scene> model;  ///< as loaded; never null once something is open
  Bounds casters;                      ///< of the model: of what casts, or of everything where nothing does
  std::vector<Light> lights;           ///< as they are now
  std::size_t selected = 0;            ///< the one whose handles, probe and overlays are shown
  Camera camera;
  RenderOptions left, right;  ///< right: the second method of split and difference
  Arrangement arrangement = Arrangement::kSingle;
  Shown shown = Shown::kPicture;
  double divider = 0.5;           ///< part of the width that shows the left method
  double exposure = 0.0;          ///< stops
  double difference_scale = 0.1;  ///< visibility that saturates the colors
  Overlays overlays;
  bool probe = false;
  bool aim = true;   ///< a light that is dragged turns to what it shone at
  int revision = 0;  ///< grows whenever a method or a setting changes

  bool two_sided() const { return arrangement != Arrangement::kSingle; }
  /// Of the selected light.
  const LightShape& shape() const { return lights[selected].shape; }
  /// It as a disk, near or distant; of a rectangle the disk around it.
  CircularLight circular() const;
  /// A distant light keeps its irradiance where its angle changes.
  void set_shape(const LightShape& shape);
  /// The selected light as its handles have it, and what they make of it.
  HandledLight handled() const { return viewer::handled(shape(), casters); }
  void set_handled(const HandledLight& light) { set_shape(changed(shape(), handled(), light)); }
};

/// The loaded scene with the lights and the camera of the state.
Scene current_scene(const State& state);

/// A state that shows `loaded`, x-viewer of its file included. Settings that x-viewer does not name are those
/// of `before`. What x-viewer holds that is not understood becomes a warning.
State opened(const std::filesystem::path& path, LoadedScene& loaded, const State& before);

}  // namespace penumbra::viewer
