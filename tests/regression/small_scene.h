#pragma once
// Leaves, and a scene of two bands with everything that a run counts, for tests that stop and divide runs.

#include <string>

namespace sunfleck::regression {

inline const std::string leaves_obj =
    "v 0 1 0\nv 0 1 1\nv 1 1 0\nv 0 0.4 0\nv 0 0.4 1\nv 1 0.4 0\nusemtl leaf\nf 1 2 3\nf 4 5 6\n";

// Contains two bands that scatter, sun and sky, a facula map and a sensor; its leaves are in leaves.obj.
inline const std::string two_band_scene =
    "[plot]\nsize = [1.0, 1.0]\n"
    "[sun]\ntime = 2002-08-08T10:10:00+08:00\nlatitude = 40.0\nlongitude = 116.0\n"
    "[sky]\nmodel = \"uniform\"\n"
    "[[band]]\nname = \"PAR\"\ndirect = 100.0\ndiffuse = 20.0\n"
    "[[band]]\nname = \"NIR\"\ndirect = 90.0\ndiffuse = 10.0\n"
    "[soil]\nreflectance = { PAR = 0.1, NIR = 0.3 }\n"
    "[optics.leaf]\nreflectance = { PAR = 0.1, NIR = 0.4 }\ntransmittance = { PAR = 0.1, NIR = 0.4 }\n"
    "[[plane]]\nheight = 0.5\ncells = [4, 4]\n"
    "[[sensor]]\nname = \"a\"\nfrom = [0.5, 0.2, 0.5]\n"
    "[[geometry]]\nfile = \"leaves.obj\"\n";

}  // namespace sunfleck::regression
