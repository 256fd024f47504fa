// All of libroomlight: how light really falls in a home.
//
//     const auto home = roomlight::Home::open("flat.sh3d");
//     const auto picture = roomlight::render(*home);
//     picture->write("flat.png");
#pragma once

#include "roomlight/basics.h"
#include "roomlight/home.h"
#include "roomlight/layers.h"
#include "roomlight/measure.h"
#include "roomlight/optimise.h"
#include "roomlight/picture.h"
#include "roomlight/program.h"
#include "roomlight/render.h"
#include "roomlight/version.h"
