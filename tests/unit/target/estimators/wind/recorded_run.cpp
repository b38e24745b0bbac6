#include "tests/unit/target/estimators/wind/recorded_run.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

namespace canhil::wind {

RecordedRun::RecordedRun() {
  const auto json = nlohmann::json::parse(std::ifstream(std::string(TEST_DATA_DIR) + "/wind/settings.json"));
  settings.algorithm = Algorithm::ekf;
  settings.process_noise = ProcessNoise::block_diagonal;
  settings.sample_period = json["dt"];
  settings.velocity_sigma = json["sig"]["vg"];
  settings.rate_sigma = json["sig"]["om"];
  settings.attitude_sigma = json["sig"]["att"];
  settings.density = {json["Q"]["va"], json["Q"]["om"], json["Q"]["att"], json["Q"]["vw"]};
  settings.theta_per_s = json["theta_hinf"].get<double>() / settings.sample_period;
  settings.theta_cap_per_s = json["cap"].get<double>() / settings.sample_period;
  settings.rate_weight = json["s_om"];
  const auto& vector = json["vectors"]["wind_v2_20pct_diagQ"];
  for (std::size_t i = 0; i < 12; ++i) {
    x0(static_cast<int>(i)) = vector["x0"][i];
    for (std::size_t j = 0; j < 12; ++j) P0(static_cast<int>(i), static_cast<int>(j)) = vector["P0"][i][j];
  }
  filtering::mirror_lower<12>(P0);  // the published P0 is symmetric only to 5e-20
  for (std::size_t k = 0; k < csv.rows(); ++k) {
    y.push_back(Eigen::Map<const Observation>(csv.from(k, "y_vn")));
    altitude.push_back(csv.at(k, "h"));
    inputs.push_back(
        {{csv.at(k, "u_de"), csv.at(k, "u_da"), csv.at(k, "u_dr")}, standard_atmosphere(altitude.back())});
  }
}

}  // namespace canhil::wind
