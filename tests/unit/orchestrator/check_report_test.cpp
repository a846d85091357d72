// What a participant may put into its reports and snapshots: names become datasets, numbers become sizes and indices.
#include "orchestrator/session/check_report.hpp"

#include <gmock/gmock.h>

#include <functional>

#include "base/error.hpp"
#include "hand_played.hpp"

namespace grainstep::orchestrator {
namespace {

using ::testing::HasSubstr;

wire::Observable observable(const std::string& name, const std::string& unit) {
  wire::Observable out;
  out.set_name(name);
  out.set_unit(unit);
  return out;
}

class Reports : public ::testing::Test {
 protected:
  Reports() : peer_(wire::STRUCTURE, *by_hand_.near_) {
    peer_.ready.set_ledger(wire::FULL);
    report_.set_window(7);
    for (auto* vector :
         {report_.mutable_momentum()->mutable_linear(), report_.mutable_momentum()->mutable_interface_impulse(),
          report_.mutable_momentum()->mutable_support_impulse()}) {
      vector->Resize(2, 0.0);
    }
    snapshot_.set_window(7);
    for (const double x : {0.0, 0.0, 1.0, 0.0, 0.0, 1.0}) snapshot_.add_position(x);
    for (const unsigned point : {0U, 1U, 2U}) snapshot_.add_cell(point);
    field_ = snapshot_.add_point_field();
    field_->set_name("velocity");
    field_->set_unit("m/s");
    field_->set_components(2);
    field_->mutable_value()->Resize(6, 0.0);
  }

  std::string refusal(const std::function<void()>& act) {
    try {
      act();
    } catch (const PeerError& error) {
      EXPECT_EQ(error.peer(), "structure");
      return error.text();
    }
    return "";
  }
  std::string report() {
    return refusal([this] { check_.report(peer_, report_); });
  }
  std::string snapshot() {
    return refusal([this] { check_.snapshot(peer_, snapshot_); });
  }

  ByHand by_hand_{"structure"};
  Peer peer_;
  ReportCheck check_{2};
  wire::Report report_;
  wire::Snapshot snapshot_;
  wire::Field* field_ = nullptr;
};

TEST_F(Reports, AreTakenAsTheyShouldBe) {
  *report_.add_observable() = observable("deflection", "m");
  *report_.add_observable() = observable("my_own_2", "kg");
  EXPECT_EQ(report(), "");
  EXPECT_EQ(report(), "");
  EXPECT_EQ(snapshot(), "");
}

TEST_F(Reports, NamesAreThoseOfDatasets) {
  for (const std::string name : {"", ".", "a/b", "a b", "Deflection", "2nd", "_a", "a.b", "\xc3\xa4"}) {
    EXPECT_FALSE(is_name(name)) << name;
    *report_.add_observable() = observable(name, "m");
    EXPECT_THAT(report(), HasSubstr("Report of window 7: observable '")) << name;
    report_.clear_observable();
  }
  EXPECT_FALSE(is_name(std::string("a\0b", 3)));
  EXPECT_FALSE(is_name(std::string(65, 'a')));
  EXPECT_TRUE(is_name(std::string(64, 'a')));
}

TEST_F(Reports, ControlCharactersDoNotReachTheTerminal) {
  *report_.add_observable() = observable("a\x1b[2Jb", "m");
  EXPECT_THAT(report(), HasSubstr("observable 'a?[2Jb' has no name"));
}

TEST_F(Reports, ANameComesOnce) {
  *report_.add_observable() = observable("load", "N");
  *report_.add_observable() = observable("load", "N");
  EXPECT_THAT(report(), HasSubstr("'load' comes twice"));
}

TEST_F(Reports, CataloguedUnitsAreThoseOfTheCatalogue) {
  *report_.add_observable() = observable("deflection", "mm");
  EXPECT_THAT(report(), HasSubstr("'deflection' has the unit 'mm'; the catalogue (proto/README.md) says 'm'"));
}

TEST_F(Reports, EveryReportHasTheSameObservables) {
  *report_.add_observable() = observable("load", "N");
  ASSERT_EQ(report(), "");
  report_.clear_observable();
  EXPECT_THAT(report(), HasSubstr("'load' is missing: the first report had it"));
  *report_.add_observable() = observable("load", "kN");
  EXPECT_THAT(report(), HasSubstr("'load' has the unit 'kN', in the first report it was 'N'"));
  report_.mutable_observable(0)->set_unit("N");
  *report_.add_observable() = observable("more", "");
  EXPECT_THAT(report(), HasSubstr("'more' is new"));
}

TEST_F(Reports, MomentaHaveTheRunsDimensions) {
  report_.mutable_momentum()->add_support_impulse(0.0);
  EXPECT_THAT(report(), HasSubstr("momentum.support_impulse has 3 components, the run has 2 dimensions"));
  report_.mutable_momentum()->clear_support_impulse();
  EXPECT_THAT(report(), HasSubstr("momentum.support_impulse has 0 components"));
  peer_.ready.set_ledger(wire::INTERFACE);  // it does not keep that book
  EXPECT_EQ(report(), "");
  report_.mutable_momentum()->clear_interface_impulse();
  EXPECT_THAT(report(), HasSubstr("momentum.interface_impulse has 0 components"));
}

TEST_F(Reports, SnapshotsAreWhole) {
  snapshot_.add_position(1.0);
  EXPECT_THAT(snapshot(), HasSubstr("position holds 7 numbers, no multiple of 2"));
  snapshot_.mutable_position()->RemoveLast();
  snapshot_.add_cell(1);
  EXPECT_THAT(snapshot(), HasSubstr("cell holds 4 point numbers, no multiple of 3"));
  snapshot_.set_cell_shape(wire::TETRAHEDRON);
  EXPECT_EQ(snapshot(), "");
  snapshot_.set_cell(0, 3);
  EXPECT_THAT(snapshot(), HasSubstr("a cell names point 3, but there are 3"));
  snapshot_.set_dimension(4);
  EXPECT_THAT(snapshot(), HasSubstr("has dimension 4; expected 2 or 3"));
}

TEST_F(Reports, FieldsFitTheirPoints) {
  field_->add_value(1.0);
  EXPECT_THAT(snapshot(), HasSubstr("point field 'velocity' holds 7 values, expected 6 (2 for each of 3)"));
  field_->set_components(0);
  EXPECT_THAT(snapshot(), HasSubstr("'velocity' has 0 components"));
  field_->set_name("../x");
  EXPECT_THAT(snapshot(), HasSubstr("point field '../x' has no name that a dataset could have"));
}

}  // namespace
}  // namespace grainstep::orchestrator
