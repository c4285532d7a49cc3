#include "app/plan_text.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

namespace seascape {
namespace {

using testing::HasSubstr;

Plan sample() {
  Plan plan{"a \"sea\", rough", "low", "a device", 64, 36, 2, 4, 4, {}};
  PlanEffect waves{"waves", "the scene names it", {}, {}, {}, {}, 2, 0};
  waves.passes = {{"rows", false, 1, 0, 0, 4},
                  {"mips", false, 2, 0, 0, 6},
                  {"bins", true, 1, 0, 0, 100, 1, {0, 0, 5u << 20}},
                  {"tiles", false, 1, 0, 0, 0, 3, {0, 0, 3u << 19}}};
  waves.pipelines = {"rows.comp", "mips.comp"};
  waves.modules = {{"rows.comp", 700, ""}, {"mips.comp", 300, ""}};
  waves.resources = {{"image", "tiles", 3u << 20}, {"buffer", "bins", 1u << 20}};
  waves.bytes = 4u << 20;
  PlanEffect foam{"foam",
                  "waves, again",
                  {{"surface", false, 1, 1, 500, 0, 0, {1u << 20, 2u << 20, 0}}},
                  {},
                  {{"surface.frag", 50, "surface"}},
                  {},
                  0,
                  0};
  plan.effects = {waves, foam};
  return plan;
}

// Controls, all seen: a sum that takes what is done once (110 dispatches; 6.5 MiB copied), one that counts shared words
// twice (1050), and one that adds up passes that two effects share (5 of 4).
TEST(PlanTotals, LeaveOutWhatIsDoneOnceAndWhatIsCountedElsewhere) {
  const Plan plan = sample();
  const PlanTotals waves = totals_of(plan.effects[0]);
  EXPECT_EQ(waves.passes, 4u);
  EXPECT_EQ(waves.dispatches, 10u);
  const PlanTotals all = totals_of(plan);
  EXPECT_EQ(all.passes, 4u);
  EXPECT_EQ(all.draws, 1u);
  EXPECT_EQ(all.triangles, 500u);
  EXPECT_EQ(all.dispatches, 10u);
  EXPECT_EQ(all.pipelines, 2u);
  EXPECT_EQ(all.modules, 2u);
  EXPECT_EQ(all.words, 1000u);
  EXPECT_EQ(all.resources, 2u);
  EXPECT_EQ(all.other_objects, 2u);
  EXPECT_EQ(all.bytes, 4u << 20);
  EXPECT_EQ(all.moved.loaded, 1u << 20);
  EXPECT_EQ(all.moved.stored, 2u << 20);
  EXPECT_EQ(all.moved.copied, 3u << 19);
}

TEST(PlanJson, HoldsWhatThePlanHolds) {
  const auto json = nlohmann::json::parse(plan_json(sample()));
  EXPECT_EQ(json.at("scene"), "a \"sea\", rough");
  EXPECT_EQ(json.at("views"), 2);
  const auto& waves = json.at("effects")[0];
  EXPECT_EQ(waves.at("because"), "the scene names it");
  EXPECT_EQ(waves.at("passes")[1].at("times"), 2);
  EXPECT_EQ(waves.at("passes")[2].at("when"), "once");
  EXPECT_EQ(waves.at("passes")[3].at("copies"), 3);
  EXPECT_EQ(waves.at("passes")[3].at("moved").at("copied_bytes"), 3 << 19);
  EXPECT_EQ(waves.at("pipelines"), (nlohmann::json{"rows.comp", "mips.comp"}));
  EXPECT_EQ(waves.at("modules")[0].at("words"), 700);
  EXPECT_FALSE(waves.at("modules")[0].contains("part_of"));
  EXPECT_EQ(waves.at("bytes"), 4 << 20);
  EXPECT_EQ(json.at("effects")[1].at("modules")[0].at("part_of"), "surface");
  EXPECT_EQ(json.at("totals").at("words"), 1000);
  EXPECT_EQ(json.at("totals").at("moved").at("loaded_bytes"), 1 << 20);
  EXPECT_EQ(json.at("totals").at("moved").at("stored_bytes"), 2 << 20);
}

TEST(PlanJson, TakesAnyName) {
  Plan plan = sample();
  plan.scene = "bad \xff byte\n";
  EXPECT_TRUE(nlohmann::json::accept(plan_json(plan)));
}

TEST(PlanCsv, HasARowAnEffectAndQuotesNames) {
  EXPECT_EQ(plan_csv(sample()),
            "scene,preset,effect,because,passes,draws,triangles,dispatches,pipelines,modules,words,resources,bytes\n"
            "\"a \"\"sea\"\", rough\",low,waves,the scene names it,4,0,0,10,2,2,1000,2,4194304\n"
            "\"a \"\"sea\"\", rough\",low,foam,\"waves, again\",1,1,500,0,0,0,0,0,0\n");
}

TEST(PlanText, SaysWhyAndHowMuch) {
  const std::string text = plan_text(sample());
  EXPECT_THAT(text, HasSubstr("64x36, 2 views, 4 x MSAA, on a device"));
  EXPECT_THAT(text, HasSubstr("waves: the scene names it\n"));
  EXPECT_THAT(text, HasSubstr("mips              every frame  2 passes, 6 dispatches\n"));
  EXPECT_THAT(text, HasSubstr("bins              once         100 dispatches, 1 copy into images; copies 5.00 MiB\n"));
  EXPECT_THAT(text, HasSubstr("tiles             every frame  3 copies into images; copies 1.50 MiB\n"));
  EXPECT_THAT(text, HasSubstr("1 draw, 500 triangles; loads 1.00 MiB, stores 2.00 MiB\n"));
  EXPECT_THAT(text, HasSubstr("50 words, within the module of surface\n"));
  EXPECT_THAT(text, testing::ContainsRegex("\nall +4 +1 +500 +10 +2 +2 +1000 +2 +4.00\n\n"));
  EXPECT_THAT(text,
              testing::EndsWith("a frame's attachments load 1.00 MiB and store 2.00 MiB; its copies move 1.50 MiB\n"));
}

// Control seen: a plan that leaves them out.
TEST(PlanText, TellsWhatIsNotAsTheSceneAsks) {
  Plan plan = sample();
  EXPECT_THAT(plan_text(plan), testing::Not(HasSubstr("warning")));
  plan.remarks = {"waves.swell_height_m: 15 m is drawn with 1 m"};
  EXPECT_THAT(plan_text(plan), HasSubstr("\nwarning: waves.swell_height_m: 15 m is drawn with 1 m\n\nwaves: "));
  EXPECT_EQ(nlohmann::json::parse(plan_json(plan)).at("warnings"), nlohmann::json(plan.remarks));
}

}  // namespace
}  // namespace seascape
