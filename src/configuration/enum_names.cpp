#include "uncertainty_identification/enum_names.h"

namespace uncertainty_identification {

const EnumNames<Structure>& enumNames(Structure) {
  static const EnumNames<Structure> kNames{{Structure::output_error, "output_error"},
                                           {Structure::arx, "arx"},
                                           {Structure::armax, "armax"},
                                           {Structure::box_jenkins, "box_jenkins"},
                                           {Structure::continuous, "continuous"},
                                           {Structure::modal, "modal"}};
  return kNames;
}

const EnumNames<Focus>& enumNames(Focus) {
  static const EnumNames<Focus> kNames{{Focus::simulation, "simulation"},
                                       {Focus::prediction, "prediction"}};
  return kNames;
}

const EnumNames<PlantFit>& enumNames(PlantFit) {
  static const EnumNames<PlantFit> kNames{{PlantFit::likelihood, "likelihood"},
                                          {PlantFit::simulation, "simulation"}};
  return kNames;
}

const EnumNames<BasisKind>& enumNames(BasisKind) {
  static const EnumNames<BasisKind> kNames{{BasisKind::fir, "fir"},
                                           {BasisKind::laguerre, "laguerre"},
                                           {BasisKind::kautz, "kautz"},
                                           {BasisKind::sensitivity, "sensitivity"},
                                           {BasisKind::parameter_spread, "parameter_spread"},
                                           {BasisKind::automatic, "auto"}};
  return kNames;
}

const EnumNames<Constraint>& enumNames(Constraint) {
  static const EnumNames<Constraint> kNames{{Constraint::zero_static_gain, "zero_static_gain"},
                                            {Constraint::zero_mean, "zero_mean"},
                                            {Constraint::free, "free"},
                                            {Constraint::explicit_matrix, "explicit"}};
  return kNames;
}

const EnumNames<Algorithm>& enumNames(Algorithm) {
  static const EnumNames<Algorithm> kNames{{Algorithm::em, "em"},
                                           {Algorithm::maximum_likelihood, "maximum_likelihood"}};
  return kNames;
}

const EnumNames<InitialState>& enumNames(InitialState) {
  static const EnumNames<InitialState> kNames{{InitialState::zero, "zero"},
                                              {InitialState::discard, "discard"},
                                              {InitialState::estimate, "estimate"},
                                              {InitialState::automatic, "auto"}};
  return kNames;
}

const EnumNames<NoiseStart>& enumNames(NoiseStart) {
  static const EnumNames<NoiseStart> kNames{{NoiseStart::zero, "zero"},
                                            {NoiseStart::stationary, "stationary"}};
  return kNames;
}

const EnumNames<Offsets>& enumNames(Offsets) {
  static const EnumNames<Offsets> kNames{{Offsets::automatic, "auto"},
                                         {Offsets::none, "none"},
                                         {Offsets::estimate, "estimate"},
                                         {Offsets::per_experiment, "per_experiment"}};
  return kNames;
}

const EnumNames<OffsetSide>& enumNames(OffsetSide) {
  static const EnumNames<OffsetSide> kNames{{OffsetSide::output, "output"},
                                            {OffsetSide::input, "input"}};
  return kNames;
}

const EnumNames<InputResampling>& enumNames(InputResampling) {
  static const EnumNames<InputResampling> kNames{{InputResampling::hold, "hold"}};
  return kNames;
}

const EnumNames<OutputResampling>& enumNames(OutputResampling) {
  static const EnumNames<OutputResampling> kNames{{OutputResampling::hold, "hold"},
                                                  {OutputResampling::linear, "linear"},
                                                  {OutputResampling::mean, "mean"}};
  return kNames;
}

const EnumNames<TimeUnit>& enumNames(TimeUnit) {
  static const EnumNames<TimeUnit> kNames{
      {TimeUnit::automatic, "auto"},  {TimeUnit::seconds, "s"},      {TimeUnit::milliseconds, "ms"},
      {TimeUnit::microseconds, "us"}, {TimeUnit::nanoseconds, "ns"}, {TimeUnit::minutes, "min"},
      {TimeUnit::hours, "h"},         {TimeUnit::days, "d"},         {TimeUnit::index, "index"}};
  return kNames;
}

const EnumNames<ExperimentMode>& enumNames(ExperimentMode) {
  static const EnumNames<ExperimentMode> kNames{{ExperimentMode::topic, "topic"},
                                                {ExperimentMode::service, "service"},
                                                {ExperimentMode::duration, "duration"},
                                                {ExperimentMode::gap, "gap"},
                                                {ExperimentMode::message, "message"}};
  return kNames;
}

const EnumNames<TransferDomain>& enumNames(TransferDomain) {
  static const EnumNames<TransferDomain> kNames{{TransferDomain::s, "s"}, {TransferDomain::z, "z"}};
  return kNames;
}

}  // namespace uncertainty_identification
