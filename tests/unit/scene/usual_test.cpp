/// @file Slips of units: a value that is a thousand times too small or too large is told before the run.
#include "scene/usual.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "declare/declaration.hpp"
#include "scene_files.hpp"

namespace grainstep::scene {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

std::vector<Finding> usual_findings(const std::string& scene, const std::vector<std::string>& overrides = {}) {
  std::vector<Finding> findings;
  check_usual(load_text(scene, overrides), findings);
  for (const Finding& finding : findings) EXPECT_EQ(finding.severity, Severity::warning) << finding.path;
  return findings;
}

TEST(Usual, SaysWhereWhatAndWhatIsUsual) {
  const auto found =
      usual_findings(replaced(minimal_scene, "thickness: 50 mm", "thickness: 50 mm, yield_strength: 470 mPa"));
  ASSERT_EQ(found.size(), 1);
  EXPECT_EQ(found[0].path, "structure.layers.0.yield_strength");
  EXPECT_EQ(found[0].text,
            "found 470 mPa; yield strengths of metals are usually 20 MPa to 5 GPa; look at its unit and prefix (m is a "
            "thousandth, M a million). What is meant may stay");
}

TEST(Usual, ComesWithTheOtherFindings) {
  const auto all = check_rules(load_text(minimal_scene, {"structure.layers.0.yield_strength=470 mPa"}));
  ASSERT_EQ(all.size(), 1);
  EXPECT_EQ(all[0].path, "structure.layers.0.yield_strength");
}

struct Slip {
  const char* key;
  const char* value;
};

void PrintTo(const Slip& slip, std::ostream* out) { *out << slip.key << "=" << slip.value; }

class UnitSlip : public testing::TestWithParam<Slip> {};

TEST_P(UnitSlip, IsTold) {
  const auto& [key, value] = GetParam();
  const auto found = usual_findings(minimal_scene, {std::string(key) + "=" + value});
  ASSERT_GE(found.size(), 1);
  EXPECT_EQ(found[0].path, key) << found[0].text;
}

INSTANTIATE_TEST_SUITE_P(
    ByAPrefixOrWithoutAUnit, UnitSlip,
    testing::Values(Slip{"structure.layers.0.yield_strength", "470 mPa"},
                    Slip{"structure.layers.0.yield_strength", "470"},
                    Slip{"structure.layers.0.yield_strength", "470 GPa"}, Slip{"structure.layers.0.young", "200"},
                    Slip{"structure.layers.0.young", "200 MPa"}, Slip{"structure.layers.0.young", "200 mPa"},
                    Slip{"structure.layers.0.density", "8"}, Slip{"structure.layers.0.density", "8000 g/cm3"},
                    Slip{"structure.layers.0.thickness", "50"}, Slip{"structure.layers.0.thickness", "50 um"},
                    Slip{"structure.half_span", "500"}, Slip{"structure.half_span", "0.5 mm"},
                    Slip{"impactor.slug.speed", "400 mm/s"}, Slip{"impactor.slug.speed", "400 km/s"},
                    Slip{"impactor.slug.half_width", "100"}, Slip{"impactor.slug.height", "300"},
                    Slip{"impactor.slug.particle.density", "2.7"}, Slip{"impactor.slug.particle.diameter", "200 nm"},
                    Slip{"impactor.slug.particle.normal_stiffness", "7300 MN/m"},
                    Slip{"impactor.slug.particle.normal_stiffness", "7.3 N/m"},
                    Slip{"impactor.slug.particle.friction", "35"}, Slip{"impactor.slug.stand_off", "100 nm"},
                    Slip{"time.end", "3 s"}, Slip{"time.end", "1e-5"}, Slip{"guards.energy_drift", "3"},
                    Slip{"structure.mesh.refinement", "0.001"}));

TEST(Usual, OfAPressureTheSizeCountsAndZeroIsNothing) {
  const std::string loaded = minimal_scene + "symmetry: plane_strain\n";
  const auto with = [&](const std::string& pressure) {
    return usual_findings(loaded, {"impactor.type=pressure", "impactor.pressure={" + pressure + "}"});
  };
  EXPECT_THAT(with("rectangular: {pressure: -86.4 MPa, duration: 0.75 ms}"), IsEmpty());
  EXPECT_THAT(with("tabulated: {time: [0 ms, 1 ms, 2 ms], pressure: [0, 80 MPa, 0]}"), IsEmpty());
  const auto soft = with("rectangular: {pressure: -86.4 mPa, duration: 0.75 ms}");
  ASSERT_EQ(soft.size(), 1);
  EXPECT_THAT(soft[0].text, HasSubstr("found -86.4 mPa; pressures of a blow are usually 1 kPa to 20 GPa"));
  const auto table = with("tabulated: {time: [0, 20, 30], pressure: [0, 80 MPa, 0]}");
  ASSERT_EQ(table.size(), 1) << "one line for a list";
  EXPECT_EQ(table[0].path, "impactor.pressure.tabulated.time.1");
}

TEST(Usual, AContactStiffnessIsJudgedOverDepthOrDiameter) {
  const auto found = usual_findings(minimal_scene, {"impactor.slug.particle.normal_stiffness=7300 MN/m"});
  ASSERT_EQ(found.size(), 1);
  EXPECT_THAT(found[0].text, HasSubstr("found 7.3 GN/m, over the depth a modulus of 7.3 TPa"));
  EXPECT_THAT(usual_findings(minimal_scene, {"impactor.slug.particle.normal_stiffness=7300 MN/m", "depth=1 m"}),
              IsEmpty());
}

// Who declares a range says of what.
void expect_words(const google::protobuf::Descriptor& section) {
  for (int i = 0; i < section.field_count(); ++i) {
    const auto& field = *section.field(i);
    const options::Key& key = declare::key_of(field);
    const bool ranged = key.has_usual_from() || key.has_usual_to();
    EXPECT_EQ(ranged, !key.usual_text().empty()) << field.full_name();
    EXPECT_TRUE(!ranged || field.cpp_type() == google::protobuf::FieldDescriptor::CPPTYPE_DOUBLE) << field.full_name();
    EXPECT_TRUE(!key.has_usual_to() || key.usual_from() < key.usual_to()) << field.full_name();
    if (field.message_type() != nullptr && !declare::is_free(field)) expect_words(*field.message_type());
  }
}

TEST(Usual, EveryRangeSaysOfWhat) { expect_words(*Scene::descriptor()); }

}  // namespace
}  // namespace grainstep::scene
