// Benchmarks of occlusion textures.
#pragma once

namespace penumbra::bench {

/// Prefilter times and ratios at 256² and 512²; frames across a 16-fold range of light radii, interleaved;
/// frames against the number of slices.
void bench_occlusion_textures();

}  // namespace penumbra::bench
