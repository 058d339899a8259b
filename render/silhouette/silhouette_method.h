// The silhouette method's registration, and that of the method `rays`, which has its certificates.
#pragma once

#include "penumbra/render/method.h"

namespace penumbra {

/// Exact areas between the edges that each receiver sees (silhouette_visibility.h).
MethodInfo silhouette_method();
/// Stratified rays, but only where the silhouette method certifies nothing.
MethodInfo rays_method();

/// The options silhouette-rows and silhouette-tolerance.
std::vector<OptionSchema> silhouette_options();

}  // namespace penumbra
