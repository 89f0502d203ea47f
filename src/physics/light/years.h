#pragma once
// The years (UTC) for which the position of the sun is known: the range to which ERFA's eraEpv00 was fitted.

namespace sunfleck {

inline constexpr int first_year = 1900;
inline constexpr int last_year = 2100;

}  // namespace sunfleck
