// Planner, step choose: how far n stratified rays are off, by pilots.
//
// A pilot has two independent estimates of V by n' rays each at m receivers in penumbra. Half their squared
// difference d_i has no bias, so R = Σ w_i d_i / Σ w_i estimates the mean squared error of n' rays, as a
// ratio of sums. Its variance is S / (Σ w_i)², S = Σ (w_i d_i - w_i R)² (the linearized variance of a ratio;
// Cochran, Sampling Techniques, 1977, section 6.4; receivers beside each other are one term, as in his
// chapter 9A on clusters). R is taken for a mean of ν squares of normal numbers with that variance, ν = 2 (Σ
// w_i d_i)² / S (Satterthwaite, An approximate distribution of estimates of variance components, 1946).
// Nineteen times of twenty the true mean is below R ν / χ²(0.05; ν). So the margin comes from the receivers
// that were looked at. S is taken to be at least what it would be if their true mean squares varied by 2/3 of
// their squared mean.
//
// From n' to n: 1 / e² = n / v + n^(3/2) / b, with the v and b of SampledFacts. The exponent is between 1 and
// 3/2 wherever it is; taken as evenly spread it is known to 1/(4√3), so log e² to 1/(4√3) |log(n / n')|.
// Pilots are weighed by the reciprocals of the variances of their logarithms.
#pragma once

#include "penumbra/render/plan/plan.h"

namespace penumbra::detail {

/// Before anything is seen of it, a penumbra is taken for that of few edges. It weighs as much as so many
/// receivers.
inline constexpr double kUsualVariance = 0.13, kUsualBoundary = 0.3, kUsualWeight = 3.0;

/// As the method `rays`: a receiver before which more edges lie than so many a ray is left to rays.
inline constexpr int kEdgesOfRay = 24;

/// Of n stratified rays on average, from v and b.
double squared_error(double samples, double variance, double boundary);

/// How likely more than `most` edges lie before a receiver at which a sample told of so many.
double chance_of_more(double edges, double most, double edges_a_sample);

/// The mean over the penumbra of the squared error of V where receivers with more than `areas_up_to` edges
/// (0: all) have so many rays, and others no error: what it is below nineteen times of twenty. Without pilots
/// by v and b, without margin. Cost O(receivers of the pilots).
double squared_error_kept(const SampledFacts& facts, int samples, int areas_up_to);

}  // namespace penumbra::detail
