#pragma once
// Writes files in CARIBU's formats, built from the rules of these formats.

#include <sstream>
#include <string>

namespace sunfleck {

inline const std::string grey_opt =
    "# reflect and transmit\nn 2\ns d 0.15\n# first\ne d 0.1 d 0.12 0.06 d 0.2 0.05\ne d 0.3  d 0.4 0.45  d 0.4 0.45\n";
inline const std::string black_opt = "n 1\ns d 0\ne d 0  d 0 0  d 0 0\n";

// Returns three checkerboards at z = 15, 10 and 5 over 20 x 20, with squares 10, 5 and 2.5 wide, as leaves 1, 2 and 3: 192
// triangles. A square wave and its copies of double frequency have no frequency in common (1, 3, 5, ... and 2, 6, 10, ...), so
// whichever direction the light shifts one layer's shadow against the next, each layer covers half of the remaining area: the
// layers intercept 1/2, 1/4 and 1/8 of any beam, and 1/8 comes through.
inline std::string filter_can() {
  constexpr int cells = 8;
  constexpr double width = 2.5;
  std::ostringstream text;
  text << "# three filters\n";
  for (int layer = 0; layer < 3; ++layer) {
    const int power = 2 - layer;  // a square of this layer is 2^power cells wide
    for (int i = 0; i < cells; ++i) {
      for (int j = 0; j < cells; ++j) {
        if (((i >> power) + (j >> power)) % 2 != 0) continue;
        const auto corner = [&](int k, int l) {
          text << "  " << width * (i + k) << ' ' << width * (j + l) << ' ' << 15 - 5 * layer;
        };
        const auto triangle = [&](int k, int l) {
          text << "p 1 10000100" << layer + 1 << 100 + cells * i + j << " 3";
          corner(0, 0);
          corner(k, l);
          corner(1 - l, 1);
          text << '\n';
        };
        triangle(1, 0);
        triangle(1, 1);
      }
    }
  }
  return text.str();
}

inline const std::string filter_domain = " 0 0\n 20 20\n";

}  // namespace sunfleck
