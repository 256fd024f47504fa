// A problem for the search: designs of integers and reals, two to four objectives to be made small. What they mean is
 // the caller's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"

namespace roomlight::search {

struct ConstGenome {
  std::span<const int32_t> integers;
  std::span<const double> reals;  // each in [0, 1]
};

// One design, a view into Genomes.
struct Genome {
  std::span<int32_t> integers;
  std::span<double> reals;
  operator ConstGenome() const { return {integers, reals}; }
};

// Many designs, flat: all integers of design 0, then those of design 1, and so on; reals alike.
struct Genomes {
  size_t integersEach = 0, realsEach = 0, count = 0;
  std::vector<int32_t> integers;  // count × integersEach
  std::vector<double> reals;      // count × realsEach

  Genome operator[](size_t i) {
    return {std::span(integers).subspan(i * integersEach, integersEach),
            std::span(reals).subspan(i * realsEach, realsEach)};
  }
  ConstGenome operator[](size_t i) const {
    return {std::span(integers).subspan(i * integersEach, integersEach),
            std::span(reals).subspan(i * realsEach, realsEach)};
  }
  void resize(size_t designs);
  void append(ConstGenome genome);
  void append(const Genomes& others);
  void assign(size_t i, ConstGenome genome);
};

struct IntegerVariable {
  int32_t cardinality = 2;  // takes 0 .. cardinality - 1
  bool ordered = false;     // neighbours are alike: a place in a row, a number of lamps; false: a category
  int32_t group = -1;       // variables of one group, for example all of one lamp, are inherited together; -1: alone
};

struct RealVariable {
  int32_t group = -1;
};

// What a polish is to do: make Σ weights[m] · objective m small, from a design with these objectives.
struct Wish {
  std::span<const double>
      weights;     // >= 0, their sum is positive; already divided by the range of each objective in the front so far
  std::span<const double> objectives;  // of the design as it is; a polish may take some of them as bounds
};

struct Problem {
  std::vector<IntegerVariable> integers;
  std::vector<RealVariable> reals;
  size_t objectives = 2;  // two to four, all made small

  // Optional: the block of each group, 0 and up. Groups of a block, for example the lamps of a room, matter to each
  // other and to those of other blocks little. The hybrid recombines designs by whole blocks, and moves what groups
// hold within them. Empty: nothing is known.
  std::vector<int32_t> blockOfGroup;

  // Writes objectives[i × Problem::objectives + m] of every design i: finite numbers that depend on that design alone,
  // not on its place among the others. Called with a generation at a time, from one thread; it may use as many as it
  // likes.
  std::function<void(const Genomes& designs, std::span<double> objectives)> evaluate;

  // Optional. Makes any genome feasible, in place; a feasible one stays as it is; the same input gives the same output.
  // Called from several threads at once. evaluate and polish see repaired genomes only.
  std::function<void(Genome)> repair;

  // Optional. `count` designs by chance, of a generation; they are repaired afterwards. The same arguments give the
  // same designs. Without it every value of every variable is as likely as any other.
  std::function<Genomes(size_t count, uint64_t seed, size_t generation)> draw;

  // Optional. Improves the reals of a repaired genome, in place. Returns what it cost, counted in evaluations of one
  // design: how many it made, or how many the same time would buy, whichever is more (a fixed figure, not a clock's).
  // The search adds one for evaluating the outcome. 0: there was nothing to improve; the genome is as it was and is not
  // evaluated again. Called from several threads at once; the same input gives the same output.
  std::function<size_t(Genome, const Wish&)> polish;

  Genomes none() const;  // no designs, of this problem's shape
};

// Errors: objectives not two to four, no variables, a cardinality below 1, groups without a block where there are
// blocks, no evaluate.
Status check(const Problem& problem);

// Every variable within its bounds and the shape right.
bool fits(const Problem& problem, const Genomes& genomes);

}  // namespace roomlight::search
