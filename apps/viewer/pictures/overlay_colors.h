// Colors of overlays, the same for what is drawn and for the legend.
#pragma once

namespace penumbra::viewer {

struct OverlayColor {
  unsigned char r, g, b, a;
};

inline constexpr OverlayColor kPenumbraColor{255, 143, 26, 255}, kUmbraColor{62, 104, 245, 255},
    kBandColor{150, 150, 150, 220};
inline constexpr OverlayColor kAllFrontColor{250, 220, 90, 110}, kMixedColor{240, 120, 40, 130},
    kNoneFrontColor{70, 90, 200, 110};
inline constexpr OverlayColor kPenumbraFacetColor{255, 150, 40, 60}, kPenumbraConeColor{255, 205, 90, 60},
    kUmbraFacetColor{70, 120, 255, 60}, kUmbraCapColor{150, 90, 255, 90};
inline constexpr OverlayColor kRegionLit{255, 230, 120, 255}, kRegionPartly{235, 130, 50, 255},
    kRegionUmbra{60, 80, 190, 255}, kRegionUnknown{120, 120, 120, 255};

}  // namespace penumbra::viewer
