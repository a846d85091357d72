#include "fe-service/impactor.hpp"

#include "base/assert.hpp"
#include "declare/ranges.hpp"
#include "fe-service/foam/foam_impactor.hpp"
#include "fe-service/load/prescribed_load.hpp"

namespace grainstep::fe {

wire::Hello Impactor::describe() const {
  wire::Hello hello = PrescribedLoad().describe();
  hello.set_backend(std::string("grainstep-fe (impactor, ") + available_kernels().front()->name + ")");
  hello.add_capabilities("foam");
  return hello;
}

wire::Ready Impactor::prepare(const wire::Setup& setup) {
  declare::require_ranges(setup.impactor().impactor(), "impactor");
  if (setup.impactor().has_guards()) declare::require_ranges(setup.impactor().guards(), "guards");
  if (setup.impactor().impactor().type() == scene::Impactor::TYPE_FOAM) {
    impactor_ = std::make_unique<FoamImpactor>();
  } else {
    impactor_ = std::make_unique<PrescribedLoad>();
  }
  return impactor_->prepare(setup);
}

void Impactor::run(const wire::Start& start, participant::ImpactorLink& link) {
  GS_ASSERT(impactor_ != nullptr, "called before prepare()");
  impactor_->run(start, link);
}

}  // namespace grainstep::fe
