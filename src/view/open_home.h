// From files to a home that a session can open.
#pragma once

#include "home/open_home.h"
#include "view/home.h"

namespace roomlight::view {

struct OpenedView {
  ViewHome home;
  home::OpenedHome opened;  // but for its scene, which is the session's
};
Result<OpenedView> openHome(home::OpenWish wish);

}  // namespace roomlight::view
