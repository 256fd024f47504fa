// The interface of libroomlight without the library: every function that include/roomlight declares, doing nothing. Its
// types and symbols are what scripts/check_abi compares with those of an earlier version.
#include <roomlight/roomlight.h>

#include <cstdlib>

namespace roomlight::inline v1 {

// clang-format off
#define NOTHING \
  { std::abort(); }

Result<Home> Home::open(const std::string&, const OpenOptions&) NOTHING
Result<Home> Home::fromArrays(const HomeArrays&, const OpenOptions&) NOTHING
std::vector<CameraInfo> Home::cameras() const NOTHING
std::string Home::defaultCamera() const NOTHING
std::vector<RoomInfo> Home::rooms() const NOTHING
std::vector<LampInfo> Home::lamps() const NOTHING
size_t Home::triangleCount() const NOTHING
std::pair<Vec3, Vec3> Home::bounds() const NOTHING
double Home::metresPerUnit() const NOTHING
const std::vector<std::string>& Home::warnings() const NOTHING
const std::vector<std::string>& Home::notes() const NOTHING
std::string Home::addedLighting() const NOTHING
std::string supportedFiles() NOTHING

int Image::width() const NOTHING
int Image::height() const NOTHING
std::span<const float> Image::rgb() const NOTHING
Status Image::write(const std::string&) const NOTHING
const Image& Picture::image() const NOTHING
bool Picture::complete() const NOTHING
const std::string& Picture::camera() const NOTHING
std::string Picture::stats() const NOTHING
Result<DisplayImage> Picture::display(const DisplayOptions&) const NOTHING
Status Picture::write(const std::string&, const DisplayOptions&) const NOTHING
Result<Layers> Picture::layers() const NOTHING
Status write(const DisplayImage&, const std::string&) NOTHING

Result<Renderer> Renderer::of(const Home&, const Settings&, const std::vector<View>&) NOTHING
size_t Renderer::viewCount() const NOTHING
Result<Picture> Renderer::picture(size_t, const Progress&) NOTHING
Result<Picture> render(const Home&, const View&, const Settings&, const Progress&) NOTHING
std::vector<std::pair<std::string, std::string>> techniques() NOTHING
std::vector<std::pair<std::string, std::string>> qualities() NOTHING

Result<Layers> Layers::open(const std::string&) NOTHING
int Layers::width() const NOTHING
int Layers::height() const NOTHING
const std::vector<LayerInfo>& Layers::list() const NOTHING
Result<std::vector<Vec3>> Layers::gains(const Dials&) const NOTHING
Result<Image> Layers::image(size_t) const NOTHING
Result<Image> Layers::mix(const Dials&) const NOTHING
Result<DisplayImage> Layers::display(const Dials&, const DisplayOptions&) const NOTHING

std::string MeterReport::table() const NOTHING
std::string MeterReport::json() const NOTHING
std::string MeterReport::csv() const NOTHING
std::string MeterReport::html() const NOTHING
const std::vector<std::string>& MeterReport::warnings() const NOTHING
Result<MeterReport> measure(const Home&, const MeterOptions&, const Progress&) NOTHING
Result<Meters> Meters::of(const Home&, const MeterOptions&, const Progress&) NOTHING
Result<std::vector<Reading>> Meters::illuminance(std::span<const float>, std::span<const float>, const Progress&) const
    NOTHING

Result<std::vector<Design>> optimise(const std::string&, const std::string&, const std::string&,
                                     const OptimiseOptions&, const Progress&) NOTHING

int runProgram(int, const char* const*) NOTHING
const char* version() NOTHING
std::string buildId() NOTHING
const char* instructionSet() NOTHING

}  // namespace roomlight::inline v1
