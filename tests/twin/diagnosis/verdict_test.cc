#include "twin/diagnosis/verdict.h"

#include <gtest/gtest.h>

namespace thermotwin::twin {
namespace {

Finding finding_of(std::string const& name, std::string const& body, double of_largest) {
  Finding finding;
  finding.hypothesis.effect = &effect(name);
  finding.hypothesis.trial = &finding.hypothesis.effect->trials[0];
  finding.hypothesis.body = body;
  finding.hypothesis.largest = 4.0;
  finding.amplitude = 4.0 * of_largest;
  finding.strength = 60.0;
  return finding;
}

std::string verdict_of(std::vector<Explanation> explanations, bool heat_left = false) {
  Diagnosis diagnosis;
  diagnosis.explanations = std::move(explanations);
  return name_of(verdict_on(diagnosis, heat_left));
}

Explanation const heat = {{finding_of("heat", "motor", 0.5)}};
Explanation const growth = {{finding_of("centrifugal_growth", "E_Z", 0.5)}};
Explanation const contact = {{finding_of("sensor_contact", "T7", 0.5)}};

TEST(Verdict, IsNoneKnownWhereHeatIsLeft) {
  EXPECT_EQ(verdict_of({}), "nothing");
  EXPECT_EQ(verdict_of({heat}), "effect");
  EXPECT_EQ(verdict_of({}, true), "none_known");
  EXPECT_EQ(verdict_of({heat}, true), "none_known");
}

TEST(Verdict, MayHaveTwoOnOneBody) {
  EXPECT_EQ(verdict_of({heat, {{finding_of("draught", "motor", 0.5)}}}), "effect");
  EXPECT_EQ(verdict_of({growth, {{finding_of("compensation", "E_Z", 0.5)}}}), "effect");
}

TEST(Verdict, IsEitherWhereOneHasTwoNames) {
  EXPECT_EQ(verdict_of({{{heat.alternatives[0], finding_of("draught", "motor", 0.5)}}, growth}), "either");
}

TEST(Verdict, IsNoneKnownWhereAFitWouldHaveMoreThanIsPlausible) {
  EXPECT_EQ(verdict_of({{{finding_of("heat", "motor", -1.25)}}}), "none_known");
  EXPECT_EQ(verdict_of({{{finding_of("heat", "motor", 1.2)}}}), "effect");
  Explanation const one_of_two = {{finding_of("hot_neighbour", "motor", 1.25), heat.alternatives[0]}};
  EXPECT_EQ(verdict_of({one_of_two}), "either");
  auto film = finding_of("flood_coolant", "motor", 1.25);
  EXPECT_EQ(verdict_of({{{film}}}), "none_known");
  film.at_least = true;
  EXPECT_EQ(verdict_of({{{film}}}), "effect");
}

TEST(Verdict, IsASensorOnlyIfItsFaultIsAllThatItErrsBy) {
  EXPECT_EQ(verdict_of({contact}), "sensor");
  EXPECT_EQ(verdict_of({contact, heat}), "effect");
  Diagnosis diagnosis;
  diagnosis.explanations = {contact};
  diagnosis.noise_heard = {{"T6", 4.0}, {"T7", 1.5}, {"T8", 1.0}, {"T9", 1.0}};
  EXPECT_EQ(name_of(verdict_on(diagnosis, false)), "sensor");
  diagnosis.noise_heard[1].second = 2.0;
  EXPECT_EQ(name_of(verdict_on(diagnosis, false)), "none_known");
  diagnosis.noise_heard = {{"T6", 8.0}, {"T7", 8.0}};  // a rough machine
  EXPECT_EQ(name_of(verdict_on(diagnosis, false)), "sensor");
}

TEST(Verdict, IsASensorHoweverLargeItsFault) {
  EXPECT_EQ(verdict_of({{{finding_of("sensor_drift", "T7", -1.25)}}}), "sensor");
}

TEST(Verdict, IsRefutedByRunsHeldOutThatOutweighTheOthers) {
  Diagnosis diagnosis;
  diagnosis.explanations = {heat, growth};
  diagnosis.vote = -119.0;
  EXPECT_EQ(name_of(verdict_on(diagnosis, false)), "effect");
  diagnosis.vote = -121.0;
  EXPECT_EQ(name_of(verdict_on(diagnosis, false)), "none_known");
  diagnosis.explanations = {contact};
  EXPECT_EQ(name_of(verdict_on(diagnosis, false)), "none_known");
  diagnosis.faulty_sensor = FaultySensor{"T6", "jumps"};  // as everybody sees
  EXPECT_EQ(name_of(verdict_on(diagnosis, false)), "sensor");
}

}  // namespace
}  // namespace thermotwin::twin
