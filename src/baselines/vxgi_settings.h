// What decides how technique `vxgi` works; the parameters of the SDK it follows. docs/methods/vxgi.md
#pragma once

#include "gather/picture.h"

namespace roomlight {

struct VxgiSettings : PictureSettings {
  VxgiSettings() { rayRoughness = 0.1f; }
  int resolution = 64;          // voxels along an edge of a level
  int levels = 5;
  float voxelSizeM = 0;         // of the finest level; 0: as large as makes it hold the room
  int cones = 8;                // diffuse, a shading
  float tracingStep = 0.5f;     // in diameters of the cone
  int maxSamples = 128;         // along a cone
  float startOffsetVoxels = 2;  // along the normal, where cones start
  bool rotateCones = true;      // about the normal, at random from shading to shading
  int directSamples = 8;        // light samples a voxel side, as in RadianceSettings
  float residual = 0.002f;      // bounces end when one changes all light by less than this share
  int maxBounces = 32;
  int bouncesAtOnce = 0;        // of an update: what is missing then follows with the next; 0: no limit
};

}  // namespace roomlight
