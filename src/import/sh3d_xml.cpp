// Home.xml after SweetHome3D.dtd: <home> holds environment, compass, cameras, levels, furniture (groups hold
 // furniture), walls and rooms.
#include "import/sh3d_home.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/utf8.h"
#include "import/failure.h"
#include "import/sh3d_element.h"

namespace roomlight::importers::sh3d {
namespace {

constexpr double kNewPhotoWidth = 400, kNewPhotoHeight = 300;  // by the DTD, with quality 0: nobody chose them
constexpr int kLargestPhoto = 65536;

constexpr size_t kMaxXmlBytes = size_t{64} << 20;
constexpr size_t kMaxThings = 200'000, kLongestName = 256;
constexpr size_t kMaxRoomPoints = 2000, kMaxLevels = 1000;
constexpr int kDeepestGroup = 64;
constexpr double kUsualTextureCm = 100, kWidestViewRad = 3;

TextureUse readTexture(const Element& e) {
  TextureUse t;
  t.image = e.text("image"), t.name = printable(e.text("name"), kLongestName);
  // Textures that came with a model have no size of their own: -1.
  const double width = e.number("width", -1, kFarthestCm), height = e.number("height", -1, kFarthestCm);
  t.widthCm = width > 1e-3 ? width : kUsualTextureCm, t.heightCm = height > 1e-3 ? height : kUsualTextureCm;
  t.xOffset = e.number("xOffset", -1e6, 1e6, 0), t.yOffset = e.number("yOffset", -1e6, 1e6, 0);
  t.angleRad = e.angleRad("angle", 0), t.scale = e.number("scale", 1e-4, 1e4, 1);
  t.fittingArea = e.flag("fittingArea", false);
  return t;
}

// Colour and shininess from attributes of `e`, the texture from its child of that use; any where `use` is empty.
Paint readPaint(const Element& e, const char* colourKey, const char* shininessKey, std::string_view use) {
  Paint paint;
  paint.colour = e.colour(colourKey);
  paint.shininess = std::min(e.number(shininessKey, 0, 128, 0), 1.0);
  e.children([&](const Element& child) {
    if (child.kind() == "texture" && (use.empty() || child.text("attribute") == use))
      paint.texture = readTexture(child);
  });
  return paint;
}

// A picture that fits its area, as one laid by size whose first repeat is just the box around these points.
void fit(const std::vector<PlanPoint>& points, TextureUse& t) {
  if (points.empty()) return;
  PlanPoint lo = points[0], hi = points[0];
  for (const PlanPoint& p : points)
    lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)}, hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
  if (!(hi.x - lo.x > 1e-3 && hi.y - lo.y > 1e-3)) return;
  t.widthCm = hi.x - lo.x, t.heightCm = hi.y - lo.y, t.angleRad = 0, t.scale = 1;
  t.xOffset = lo.x / t.widthCm, t.yOffset = -lo.y / t.heightCm;
}

class Reader {
 public:
  explicit Reader(Warnings& warnings) : warnings_(warnings) {}

  Home home(const Element& root) {
    if (root.kind() != "home") fail(root.place(), "is not a home");
    home_.wallHeightCm = root.sizeCm("wallHeight", 250);
    home_.camera = root.text("camera", "topCamera");
    root.children([&](const Element& e) { child(e); });
    connect();
    return std::move(home_);
  }

 private:
  void child(const Element& e) {
    const std::string_view kind = e.kind();
    if (kind == "environment") environment(e);
    if (kind == "compass") compass(e);
    if (kind == "camera" || kind == "observerCamera") camera(e);
    if (kind == "level") level(e);
    if (kind == "wall") wall(e);
    if (kind == "room") room(e);
    if (kind == "polyline" && e.has("elevation")) polyline(e);
    if (kind == "label" && e.has("pitch")) warnings_.add("labels shown in 3D are left out");
    furniture(e, 0, -1);
    if (home_.walls.size() + home_.rooms.size() + home_.levels.size() + home_.cameras.size() + home_.pieces.size() +
            home_.polylines.size() >
        kMaxThings) {
      fail("Home.xml", fmt::format("holds more than {} things", kMaxThings));
    }
  }

  void environment(const Element& e) {
    Environment& env = home_.environment;
    env.groundColour = e.colour("groundColor"), env.skyColour = e.colour("skyColor"),
    env.lightColour = e.colour("lightColor");
    readPhoto(e, env);
    e.children([&](const Element& c) {
      if (c.kind() == "texture" && c.text("attribute") == "groundTexture") env.groundTexture = readTexture(c);
      if (c.kind() == "texture" && c.text("attribute") == "skyTexture") env.skyTexture = readTexture(c);
    });
  }

  // A fixed ratio rules over the height; that of the 3D view is not known, so that the last height stands for it.
  static void readPhoto(const Element& e, Environment& env) {
    static constexpr std::array<std::pair<std::string_view, double>, 6> kRatios = {{{"RATIO_4_3", 4.0 / 3},
                                                                                    {"RATIO_3_2", 1.5},
                                                                                    {"RATIO_16_9", 16.0 / 9},
                                                                                    {"RATIO_2_1", 2},
                                                                                    {"RATIO_24_10", 2.4},
                                                                                    {"SQUARE_RATIO", 1}}};
    const double width = e.number("photoWidth", 1, 1e6, kNewPhotoWidth),
                 height = e.number("photoHeight", 1, 1e6, kNewPhotoHeight);
    const std::string ratio = e.text("photoAspectRatio", "VIEW_3D_RATIO");
    const auto fixed = std::find_if(kRatios.begin(), kRatios.end(), [&](const auto& r) { return r.first == ratio; });
    env.photoAspect = fixed == kRatios.end() ? width / height : fixed->second;
    const PhotoWish photo{static_cast<int>(width), std::max(1, static_cast<int>(std::lround(width / env.photoAspect))),
                          static_cast<int>(e.number("photoQuality", 0, 3, 0))};
    const bool isNew = width == kNewPhotoWidth && height == kNewPhotoHeight && photo.quality == 0;
    if (!isNew && std::max(photo.widthPx, photo.heightPx) <= kLargestPhoto) env.photo = photo;
  }

  void compass(const Element& e) {
    Compass c;
    c.northRad = e.angleRad("northDirection", 0);
    c.latitudeRad = e.numberIfAny("latitude", -1.5708, 1.5708),
    c.longitudeRad = e.numberIfAny("longitude", -3.1416, 3.1416);
    c.timeZone = e.text("timeZone");
    home_.compass = c;
  }

  void camera(const Element& e) {
    Camera c;
    c.kind = e.text("attribute", e.kind() == "camera" ? "topCamera" : "observerCamera");
    if (c.kind == "cameraPath") return;  // of a video
    c.name = e.text("name");
    c.x = e.lengthCm("x"), c.y = e.lengthCm("y"), c.z = e.lengthCm("z");
    c.yawRad = e.angleRad("yaw"), c.pitchRad = e.angleRad("pitch");
    c.fieldOfViewRad = std::min(e.number("fieldOfView", 0.01, 6.3), kWidestViewRad);  // lenses that are none see more
    c.timeMs = e.integerIfAny("time");
    const std::string lens = e.text("lens", "PINHOLE");
    c.pinhole = lens == "PINHOLE" || lens == "NORMAL";
    home_.cameras.push_back(c);
  }

  void level(const Element& e) {
    Level l;
    l.id = e.text("id"), l.name = e.text("name");
    l.elevationCm = e.lengthCm("elevation"), l.floorThicknessCm = e.sizeCm("floorThickness"),
    l.heightCm = e.sizeCm("height");
    l.viewable = e.flag("viewable", true);
    if (!levels_.emplace(l.id, static_cast<int>(home_.levels.size())).second)
      e.failAt("id", "is that of another level too");
    home_.levels.push_back(l);
    if (home_.levels.size() > kMaxLevels) fail(e.place(), fmt::format("there are more than {} levels", kMaxLevels));
  }

  int levelOf(const Element& e, int absent = -1) const {
    if (!e.has("level")) return absent;
    const auto it = levels_.find(e.text("level"));
    if (it == levels_.end())
      e.failAt("level", fmt::format("names '{}', which does not exist", printable(e.text("level"))));
    return it->second;
  }

  void wall(const Element& e) {
    Wall w;
    w.id = e.text("id"), w.place = e.place(), w.level = levelOf(e);
    w.start = {e.lengthCm("xStart"), e.lengthCm("yStart")}, w.end = {e.lengthCm("xEnd"), e.lengthCm("yEnd")};
    if (e.has("height")) w.heightCm = e.sizeCm("height");
    if (e.has("heightAtEnd")) w.heightAtEndCm = e.sizeCm("heightAtEnd");
    w.thicknessCm = e.number("thickness", 0, 1e5);
    w.arcExtentRad = e.number("arcExtent", -6.2832, 6.2832, 0);
    w.topColour = e.colour("topColor");
    w.left = readPaint(e, "leftSideColor", "leftSideShininess", "leftSideTexture");
    w.right = readPaint(e, "rightSideColor", "rightSideShininess", "rightSideTexture");
    e.children([&](const Element& c) {
      if (c.kind() != "baseboard") return;
      Baseboard b{c.number("thickness", 0, 1e4), c.sizeCm("height"), readPaint(c, "color", "shininess", "")};
      (c.text("attribute") == "leftSideBaseboard" ? w.leftBaseboard : w.rightBaseboard) = b;
    });
    if (!w.id.empty() && !wallIds_.emplace(w.id, static_cast<int>(home_.walls.size())).second)
      e.failAt("id", "is that of another wall too");
    joins_.emplace_back(e.text("wallAtStart"), e.text("wallAtEnd"));
    home_.walls.push_back(std::move(w));
  }

  // Joins name walls that may come later.
  void connect() {
    const auto find = [&](const std::string& id) {
      if (id.empty()) return -1;
      const auto it = wallIds_.find(id);
      if (it == wallIds_.end()) warnings_.mended("walls are joined to walls that do not exist");
      return it == wallIds_.end() ? -1 : it->second;
    };
    for (size_t i = 0; i < home_.walls.size(); ++i)
      home_.walls[i].atStart = find(joins_[i].first), home_.walls[i].atEnd = find(joins_[i].second);
  }

  void room(const Element& e) {
    Room r;
    r.name = e.text("name"), r.place = e.place(), r.level = levelOf(e);
    r.floorVisible = e.flag("floorVisible", true), r.ceilingVisible = e.flag("ceilingVisible", true);
    r.ceilingFlat = e.flag("ceilingFlat", false);
    r.floor = readPaint(e, "floorColor", "floorShininess", "floorTexture");
    r.ceiling = readPaint(e, "ceilingColor", "ceilingShininess", "ceilingTexture");
    e.children([&](const Element& c) {
      if (c.kind() == "point") r.points.push_back({c.lengthCm("x"), c.lengthCm("y")});
    });
    if (r.points.size() > kMaxRoomPoints) fail(e.place(), fmt::format("has more than {} points", kMaxRoomPoints));
    for (Paint* paint : {&r.floor, &r.ceiling}) {
      if (paint->texture && paint->texture->fittingArea) fit(r.points, *paint->texture);
    }
    home_.rooms.push_back(std::move(r));
  }

  void polyline(const Element& e) {
    Polyline p;
    p.place = e.place(), p.level = levelOf(e);
    p.thicknessCm = e.number("thickness", 0, 1e4, 1), p.elevationCm = e.lengthCm("elevation");
    p.colour = e.colour("color").value_or(0), p.closed = e.flag("closedPath", false);
    e.children([&](const Element& c) {
      if (c.kind() == "point") p.points.push_back({c.lengthCm("x"), c.lengthCm("y")});
    });
    if (p.points.size() > kMaxRoomPoints) fail(e.place(), fmt::format("has more than {} points", kMaxRoomPoints));
    if (e.text("dashStyle", "SOLID") != "SOLID") warnings_.add("dashed lines shown in 3D are whole");
    if (e.text("startArrowStyle", "NONE") != "NONE" || e.text("endArrowStyle", "NONE") != "NONE")
      warnings_.add("arrows of lines shown in 3D are left out");
    if (e.text("joinStyle") == "CURVED") warnings_.add("curved lines shown in 3D are straight between their points");
    home_.polylines.push_back(std::move(p));
  }

  // Pieces of a group stand on the group's level where they name none.
  void furniture(const Element& e, int depth, int level) {
    const std::string_view kind = e.kind();
    if (kind == "furnitureGroup") {
      if (depth > kDeepestGroup) fail(e.place(), fmt::format("groups are nested more than {} deep", kDeepestGroup));
      if (!e.flag("visible", true)) return;
      const int own = levelOf(e, level);
      e.children([&](const Element& c) { furniture(c, depth + 1, own); });
      return;
    }
    const bool door = kind == "doorOrWindow", light = kind == "light";
    if (!door && !light && kind != "pieceOfFurniture" && kind != "shelfUnit") return;
    if (!e.flag("visible", true)) return;
    Piece p;
    p.kind = door || e.flag("doorOrWindow", false) ? PieceKind::DoorOrWindow
             : light                               ? PieceKind::Light
                                                   : PieceKind::Furniture;
    p.name = printable(e.text("name"), kLongestName);  // copied for each part of its model
    p.place = e.place(), p.level = levelOf(e, level);
    placement(e, p);
    look(e, p);
    if (p.kind == PieceKind::DoorOrWindow) doorOrWindow(e, p);
    if (p.kind == PieceKind::Light) p.power = e.number("power", 0, 100, 0.5);
    home_.pieces.push_back(std::move(p));
    if (home_.pieces.size() > kMaxThings)
      fail(e.place(), fmt::format("there are more than {} pieces of furniture", kMaxThings));
  }

  static void placement(const Element& e, Piece& p) {
    p.centre = {e.lengthCm("x"), e.lengthCm("y")};
    p.elevationCm = e.lengthCm("elevation", 0);
    p.angleRad = e.angleRad("angle", 0), p.pitchRad = e.angleRad("pitch", 0), p.rollRad = e.angleRad("roll", 0);
    p.widthCm = e.sizeCm("width"), p.depthCm = e.sizeCm("depth"), p.heightCm = e.sizeCm("height");
    p.heightInPlanCm = e.numberIfAny("heightInPlan", 0, kFarthestCm);
    p.mirrored = e.flag("modelMirrored", false);
    p.model = e.text("model");
    e.numbers("modelRotation", p.modelRotation);
    p.modelFlags = static_cast<int>(e.number("modelFlags", 0, 1e6, 0));
    p.staircaseCutOutShape = e.text("staircaseCutOutShape");
  }

  static void look(const Element& e, Piece& p) {
    p.paint = readPaint(e, "color", "shininess", "");
    p.shininessGiven = e.has("shininess");
    e.children([&](const Element& c) {
      if (c.kind() == "material")
        p.materials.push_back(
            {c.text("name"), c.text("key"), readPaint(c, "color", "shininess", ""), c.has("shininess")});
      if (c.kind() == "transformation") {
        Transformation t;
        t.name = c.text("name");
        c.numbers("matrix", t.rows);
        p.transformations.push_back(t);
      }
      if (c.kind() == "lightSource") {
        LightSource s{c.number("x", -100, 100), c.number("y", -100, 100), c.number("z", -100, 100),
                      c.colour("color").value_or(0xffffff), c.numberIfAny("diameter", 0, 100)};
        p.lightSources.push_back(s);
      }
      if (c.kind() == "lightSourceMaterial") p.lightSourceMaterials.push_back(c.text("name"));
    });
  }

  static void doorOrWindow(const Element& e, Piece& p) {
    DoorOrWindow& d = p.door;
    d.cutOutOnBothSides = e.flag("wallCutOutOnBothSides", false);
    d.cutOutShape = e.text("cutOutShape");
  }

  Home home_;
  Warnings& warnings_;
  std::map<std::string, int> levels_, wallIds_;
  std::vector<std::pair<std::string, std::string>> joins_;
};

}  // namespace

double slabBelowCm(const Home& home, int level) {
  if (level < 0) return 0;
  const Level& own = home.levels[static_cast<size_t>(level)];
  for (const Level& other : home.levels) {
    if (other.elevationCm < own.elevationCm) return own.floorThicknessCm;
  }
  return 0;
}

Home readHomeXml(std::span<const uint8_t> xml, Warnings& warnings) {
  if (xml.size() > kMaxXmlBytes) fail("Home.xml", fmt::format("is larger than {} MiB", kMaxXmlBytes >> 20));
  const LineNumbers lines({reinterpret_cast<const char*>(xml.data()), xml.size()});
  pugi::xml_document document;
  // Entities that a document defines are not expanded: parse_default knows only the five of XML.
  const pugi::xml_parse_result parsed = document.load_buffer(xml.data(), xml.size());
  if (!parsed)
    fail(fmt::format("Home.xml: line {}", lines.at(static_cast<size_t>(parsed.offset))),
         fmt::format("is damaged: {}", parsed.description()));
  if (!document.document_element()) fail("Home.xml", "is empty");
  return Reader(warnings).home(Element(document.document_element(), lines));
}

}  // namespace roomlight::importers::sh3d
