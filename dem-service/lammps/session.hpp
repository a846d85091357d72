/// @file One LAMMPS instance, owned; its errors as exceptions.
#pragma once

#include <mpi.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace grainstep::dem {

/// LAMMPS found an error. Debian's LAMMPS is built without exceptions and would end the process; this program puts its
/// own Error::all and Error::one in their place (docs/decisions/0001-how-lammps-is-driven.md), which throw this.
class LammpsFailure : public std::runtime_error {
 public:
  LammpsFailure(const std::string& text, bool on_every_rank)
      : std::runtime_error(text), on_every_rank_(on_every_rank) {}
  [[nodiscard]] bool on_every_rank() const noexcept { return on_every_rank_; }

 private:
  bool on_every_rank_;
};

class LammpsSession {
 public:
  /// Collective over `communicator`. `log`: file name, empty for none. LAMMPS writes nothing else.
  LammpsSession(MPI_Comm communicator, const std::string& log);
  ~LammpsSession();
  LammpsSession(const LammpsSession&) = delete;
  LammpsSession& operator=(const LammpsSession&) = delete;
  LammpsSession(LammpsSession&&) = delete;
  LammpsSession& operator=(LammpsSession&&) = delete;

  /// Runs one command, collectively. Throws NumericalError with the command and LAMMPS's own words. Where LAMMPS fails
  /// on one of several ranks alone, the others would wait for ever: the text goes to stderr and the MPI job is aborted.
  void command(const std::string& text);

  /// Runs a script up to its first `run`, collectively; false where it has none. Throws as command() does.
  [[nodiscard]] bool run_script(const std::string& path);

  /// Of particles of type 1; `identity` from 1.
  struct NewParticles {
    const std::vector<int>& identity;
    const std::vector<double>& position;  ///< m, three each
    const std::vector<double>& velocity;  ///< m/s, likewise
  };
  void create_particles(const NewParticles& particles);

  [[nodiscard]] void* handle() { return handle_; }
  [[nodiscard]] LAMMPS_NS::LAMMPS& lammps() { return *static_cast<LAMMPS_NS::LAMMPS*>(handle_); }

 private:
  template <typename Work>
  void guarded(const std::string& where, Work&& work);

  MPI_Comm communicator_;
  void* handle_;
};

}  // namespace grainstep::dem
