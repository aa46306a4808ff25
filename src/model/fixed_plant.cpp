#include "model/fixed_plant.h"

#include "model/box_jenkins.h"

namespace uncertainty_identification {
namespace {

/// Box-Jenkins noise model; the plant is fixed and has no parameters.
class FixedPlant : public NominalModel {
 public:
  FixedPlant(const Polynomials& plant, int nc, int nd) : plant_(plant), nc_(nc), nd_(nd) {
    NominalModelOptions options;
    options.nb = static_cast<int>(plant.b.size());
    options.na = static_cast<int>(plant.a.size());
    options.nc = nc;
    options.nd = nd;
    options.delay = plant.delay;
    whole_ = makeBoxJenkins(options);
  }

  std::string structure() const override { return nc_ + nd_ == 0 ? "output_error" : "box_jenkins"; }

  std::vector<std::string> names() const override {
    const std::vector<std::string> all = whole_->names();
    return {all.end() - (nc_ + nd_), all.end()};
  }

  Polynomials polynomials(const Eigen::VectorXd& theta) const override {
    return whole_->polynomials(whole(theta));
  }

  Eigen::MatrixXd jacobian(const Eigen::VectorXd& theta) const override {
    return whole_->jacobian(whole(theta)).rightCols(theta.size());
  }

  Eigen::VectorXd toUnbounded(const Eigen::VectorXd& theta) const override {
    return whole_->toUnbounded(whole(theta)).tail(theta.size());
  }

  Eigen::VectorXd fromUnbounded(const Eigen::VectorXd& z) const override {
    return whole_->fromUnbounded(whole(z)).tail(z.size());
  }

  Eigen::MatrixXd unboundedJacobian(const Eigen::VectorXd& z) const override {
    return whole_->unboundedJacobian(whole(z)).bottomRightCorner(z.size(), z.size());
  }

  Eigen::VectorXd fromPolynomials(const Polynomials& p) const override {
    return whole_->fromPolynomials(p).tail(nc_ + nd_);
  }

 private:
  Eigen::VectorXd whole(const Eigen::VectorXd& noise) const {
    Eigen::VectorXd all(plant_.b.size() + plant_.a.size() + noise.size());
    all << plant_.b, plant_.a, noise;
    return all;
  }

  Polynomials plant_;
  int nc_, nd_;
  std::shared_ptr<const NominalModel> whole_;
};

}  // namespace

std::shared_ptr<const NominalModel> fixPlant(const Polynomials& plant, int nc, int nd) {
  return std::make_shared<FixedPlant>(plant, nc, nd);
}

}  // namespace uncertainty_identification
