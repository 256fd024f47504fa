// Linearity: what candidates give one by one adds up to the full solution of a design.
#include "optimise/response.h"

#include "optimise/proposal.h"
#include "unit/optimise/small_study.h"

namespace roomlight::optimise {
namespace {

class ResponseTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    problem_ = new testing::SmallProblem();
    const RenderProgress progress;
    RenderStats stats;
    Stages stages(progress, stats);
    const ResponseProblem p{problem_->file.home,
                            problem_->file.study(),
                            problem_->candidates,
                            problem_->meters,
                            {.render = RenderSettings(), .tolerance = 0.005, .mostSamples = 4096}};
    std::vector<ResponseItem> items;
    for (size_t i = 0; i < itemCount(p); ++i) {
      auto item = findItem(p, i, stages);
      ASSERT_TRUE(item) << item.error();
      items.push_back(std::move(*item.value()));
    }
    problem_->response = responseOf(sizesOf(p), items);
    problem_->model = makeModel(problem_->file.study(), problem_->candidates, problem_->meters, problem_->response);
  }
  static void TearDownTestSuite() { delete problem_; }
  static testing::SmallProblem* problem_;
};
testing::SmallProblem* ResponseTest::problem_ = nullptr;

TEST_F(ResponseTest, EveryCandidateLightsTheRoom) {
  const Response& r = problem_->response;
  for (size_t c = 0; c < problem_->candidates.candidates.size(); ++c) {
    double sum = 0;
    for (size_t i = 0; i < problem_->meters.points(); ++i) sum += static_cast<double>(luminance(r.of(c)[i]));
    EXPECT_GT(sum / static_cast<double>(problem_->meters.points()), 3) << c;
  }
}

TEST_F(ResponseTest, SumOfResponsesIsTheFullSolution) {
  const Model& m = problem_->model;
  search::Genomes designs = testing::darkDesigns(m, 1);
  for (size_t p = 0; p < m.places(); ++p) {
    designs[0].integers[p] = p % 2 ? 1 + static_cast<int32_t>(p % (m.firstOption[p + 1] - m.firstOption[p])) : 0;
    designs[0].reals[p] = 0.3 + 0.1 * static_cast<double>(p % 7);
  }
  const RenderProgress progress;
  RenderStats stats;
  Stages stages(progress, stats);
  const auto c = certify(problem_->file.home, {problem_->file.study(), problem_->candidates, m, designs[0]},
                         problem_->meters, {}, RenderSettings(), stages);
  ASSERT_TRUE(c) << c.error();
  const Certificate::OfCondition& night = c.value()->conditions[0];
  EXPECT_EQ(night.judged, problem_->meters.points());
  EXPECT_LT(night.maxPercent, 3);
  EXPECT_LT(night.meanPercent, 1);
  EXPECT_GT(night.uncertainPercent, 0);
  EXPECT_LT(night.uncertainPercent, 1.5);
  // UGR by terms and backgrounds that add up, against the glare meter.
  const DesignResult result = resultOf(m, designs[0]);
  EXPECT_NEAR(result.conditions[0].ugr[0], night.fullUgr[0], 0.3);
  EXPECT_GT(night.fullUgr[0], 5);
}

}  // namespace
}  // namespace roomlight::optimise
