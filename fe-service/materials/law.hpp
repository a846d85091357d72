/// @file What a material law is to the rest of the program. To add one:
///   1. its file in this folder: a struct of parameters with the members below, and correct() (or, where its flow is
///      radial, the three functions that materials/radial_flow.hpp asks for);
///   2. its name in the list of materials/laws.hpp;
///   3. its word, and keys of its own, in scene.Layer (proto/grainstep/scene.proto).
/// It then works in both measures, on every instruction set, in ledgers, snapshots, previews and the handshake.
///
/// Members of a law:
///     static constexpr LawTraits kTraits     what is known of all of its kind
///     using Memory                           what a step keeps per triangle between predictor and correction
///     static Law from(structure, layer)      from the scene's keys; not needed without a word. In the header only as a
///                                            template over the structure's type: the element loop's copies, compiled
///                                            with -ffast-math for other machines, must not meet protobuf's functions
///     const Elastic& elasticity() const      its elastic part
///     double step_parameter(step) const      what its correction wants to know of the step's length
///     double initial(component) const        state of an undeformed point
/// Functions, found beside it:
///     remember(memory, i, volume, old stress, predictor, half_tangent)
///     correct(law, state, memory, parameter, lanes, work, outcome)
///         from the elastic predictors in `state` (kernel/layout.hpp) to the stresses of a batch; adds the plastic work
///         of the first `lanes` quads to `work`, J
#pragma once

namespace grainstep::fe {

/// Where a law keeps no plastic strain.
inline constexpr int kNoFlow = -1;

struct LawTraits {
  const char* word;   ///< of structure.layers[].material; nullptr: no layer can have it
  int state;          ///< components of a triangle's state, stress included
  int flow;           ///< the component that is reported as plastic strain, or kNoFlow
  bool keeps_volume;  ///< its flow does: in solids of revolution a quad's triangles share their dilatation
  double seconds;     ///< of one triangle and step while it flows, measured with bench_fe_kernel (AVX-512, one core)
};

/// What a row's sweep found, beside stresses and forces.
struct RowOutcome {
  double plastic_work = 0.0;    ///< J, of this step
  double stored = 0.0;          ///< J, by which this step raised the stored energy; of foam only
  double min_twice_area = 0.0;  ///< m^2, at the end of the step
  int yielding = 0;             ///< batches with plastic flow
  int unconverged = 0;          ///< batches whose local iteration did not converge
};

}  // namespace grainstep::fe
