// What tables of the plan file have in common: axes and options. Each adds to the words of the command; what is wrong
// is kept by the place that it stands at.
#pragma once

#include "batch/plan_file.h"
#include "optimise/toml_tree.h"

namespace roomlight::batch {

// Files of a plan: as written beside the plan, and as the batch's folder knows them.
struct PlanPaths {
  std::filesystem::path plan, batch;  // folders, absolute and without symbolic links
  std::string related(const std::filesystem::path& written) const;
};

// What people call a file of the plan: as written there, without extension, and without where all of the disk it is.
std::string labelOf(const std::string& file);

// As TomlPlace::isTable, but an unknown key is answered by the nearest one.
bool knowsKeys(const optimise::TomlPlace& table, const std::vector<std::string>& keys);

// The file named here, an input of all tasks of the section; as the batch's folder knows it.
std::string fileAt(const optimise::TomlPlace& place, const PlanPaths& paths, Section& out);

void addAxis(Section& out, Axis axis);

// `homes`: files, or patterns with * and ?.
void readHomes(const optimise::TomlPlace& table, const PlanPaths& paths, Section& out);
void readCameras(const optimise::TomlPlace& table, Section& out);
// `lights`: names as `--light` takes them, or lighting files.
void readLights(const optimise::TomlPlace& table, const PlanPaths& paths, Section& out);
void readTechniques(const optimise::TomlPlace& table, Section& out);
// `seeds`: how many, from 0, or a list of them.
void readSeeds(const optimise::TomlPlace& table, bool together, Section& out);

// `size`; returns its pixels over those of a usual picture, 1 without a size.
double readSize(const optimise::TomlPlace& table, Section& out);
// `quality`, `samples`; returns what they say of the time of a usual picture, in seconds.
double readEffort(const optimise::TomlPlace& table, Section& out);
// `settings`, `options`, `seconds`.
void readRest(const optimise::TomlPlace& table, const PlanPaths& paths, Section& out);

}  // namespace roomlight::batch
