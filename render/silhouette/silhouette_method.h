// The silhouette method's registration, and that of the method `rays`, which has its certificates.
#pragma once

#include "penumbra/render/method.h"

namespace penumbra {

struct SilhouetteOptions;

/// Exact areas between the edges that each receiver sees (silhouette_visibility.h).
MethodInfo silhouette_method();
/// Stratified rays, but only where the silhouette method certifies nothing.
MethodInfo rays_method();

/// The options silhouette-rows and silhouette-tolerance.
std::vector<OptionSchema> silhouette_options();

/// What the method rays asks of silhouettes before it traces rays, by its options.
SilhouetteOptions rays_certificates(const OptionValues& options);

}  // namespace penumbra
