#pragma once

namespace nook {

/// z with P(|Z| <= z) = confidence for a standard normal Z; confidence in (0, 1).
double normal_quantile(double confidence);

/// t with P(|T| <= t) = confidence for Student's distribution; degrees >= 1, confidence in (0, 1).
double student_quantile(double confidence, unsigned degrees);

}  // namespace nook
