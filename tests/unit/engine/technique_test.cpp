// What the registry says of techniques, written out once: other tests take their lists from it, and would not miss a
// technique that is gone from them.
#include "engine/technique.h"

#include <gtest/gtest.h>

#include "support/techniques.h"

namespace roomlight {
namespace {

using Names = std::vector<std::string>;

TEST(Techniques, areThese) {
  EXPECT_EQ(test::allTechniques(), (Names{"hybrid", "cone", "vxgi", "lpv", "photon", "path"}));
  EXPECT_EQ(RenderSettings().technique, test::allTechniques().front());
}

TEST(Techniques, sayWhatTheyCanDo) {
  EXPECT_EQ(test::techniquesThatCan(&Technique::layers), (Names{"hybrid", "path"}));
  EXPECT_EQ(test::techniquesThatCan(&Technique::followsDaylight), (Names{"hybrid", "cone", "photon", "path"}));
  EXPECT_EQ(test::techniquesThatCan(&Technique::keepsWhatStands), (Names{"hybrid", "cone", "vxgi", "lpv"}));
  EXPECT_EQ(test::techniquesThatCan(&Technique::hasSnapshots), (Names{"hybrid", "cone"}));
  EXPECT_EQ(test::techniquesThatCan(&Technique::sharesLight), (Names{"hybrid", "cone"}));
  EXPECT_EQ(test::techniquesThatCan(&Technique::fillsTimeLimit), (Names{"hybrid", "path"}));
  EXPECT_EQ(test::techniquesThatCan(&Technique::refinesToTruth), (Names{"hybrid", "path"}));
  EXPECT_EQ(test::walkingTechniques(), (Names{"hybrid", "cone", "vxgi", "lpv", "photon"}));
  EXPECT_EQ(test::validatedTechniques(), (Names{"hybrid", "cone", "path"}));
  EXPECT_EQ(test::preciseTechniques(), (Names{"hybrid", "path"}));
}

TEST(Techniques, areFoundByTheirNames) {
  for (const Technique* t : techniques()) EXPECT_EQ(findTechnique(t->name), t);
  EXPECT_EQ(findTechnique("radiosity"), nullptr);
  EXPECT_EQ(techniqueNamed("radiosity").error(),
            "unknown technique 'radiosity'; there are hybrid, cone, vxgi, lpv, photon, path");
}

}  // namespace
}  // namespace roomlight
