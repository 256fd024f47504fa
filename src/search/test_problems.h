// Problems with known fronts that the searches are measured on. All objectives are to be made small; every genome is
 // feasible unless said.
#pragma once

#include <vector>

#include "search/problem.h"

namespace roomlight::search {

struct TestProblem {
  const char* name;
  Problem problem;
  std::vector<double> reference;   // point for the hypervolume
  double bestHypervolume = 0;      // of the whole front, up to the reference
  double askedHypervolume = 0;     // 0: nothing asked
};

// Zitzler, Deb and Thiele 2000: 30 reals; convex, concave and broken front.
TestProblem zdt1();
TestProblem zdt2();
TestProblem zdt3();
// Deb, Thiele, Laumanns and Zitzler 2002: an eighth of a sphere, three objectives, 12 reals.
TestProblem dtlz2();
// The front of zdt1 over 10 categories of 6 values and 10 reals: g is 1 only for one value of each category, and the
// reals' best depends on their category. Polish moves the reals alone.
TestProblem mixedZdt1();
// Eight lamps on 24 places of a ceiling line, 2.4 m above 192 points of a floor; three kinds of lamp, dimmed by the
// reals. Objectives: watts, and the root mean square of (E - 100 lx) / 100 lx over the points. Repair: lamps stand in
// order and no two in a place. Polish: bounded least squares with a price on watts. The front is not known.
TestProblem lampRow();

}  // namespace roomlight::search
