// What exact classification costs: `./run bench price`.
#pragma once

namespace penumbra::bench {

/// Prints, for ordinary meshes and for faces built tangent to the light, nanoseconds a face and faces
/// classified wrongly by plain float, plain double, the filtered tiers and exact arithmetic throughout.
void compare_prices_of_classification();

}  // namespace penumbra::bench
