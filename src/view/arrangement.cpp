#include "view/arrangement.h"

namespace roomlight::view {

Arrangement::Arrangement(const EditableHome& home, const Scene& atRest, const HomeState& atStart)
    : shapes_(home, atRest), overlaps_(shapes_, atStart) {}

void Arrangement::takeAlong(const Edit& edit, const HomeState& from, Edited& edited) {
  if (!edited.moved) return;
  const size_t thing = *edited.moved;
  if (!found_ || found_->thing != thing || !(found_->state == from))
    found_ = Found{thing, from, findLoad(shapes_, thing, from)};
  carry(shapes_.home(), found_->load, thing, edit.set.alone.value_or(false), from, edited.state);
}

}  // namespace roomlight::view
