#include "bench/live/admission.hpp"

#include <gtest/gtest.h>

namespace canhil::live {
namespace {

const Admission here{.address = "127.0.0.1", .loopback = true, .port = 8460, .token = ""};
const Admission everywhere{.address = "bench", .loopback = false, .port = 8460, .token = "0123abcd"};

Asked page(std::string_view target = "/", std::string_view host = "127.0.0.1:8460",
           std::string_view origin = "") {
  return {.method = "GET", .target = target, .host = host, .origin = origin};
}
Asked socket(std::string_view host, std::string_view origin) {
  return {.method = "GET", .target = "/live", .host = host, .origin = origin, .upgrade = true};
}

TEST(LiveAdmission, AnswersThePage) {
  EXPECT_EQ(admit(here, page()).status, 200U);
  EXPECT_EQ(admit(here, page("/chart.js")).what, "/chart.js");
  EXPECT_EQ(admit(here, page("/", "localhost:8460")).status, 200U);
  EXPECT_EQ(admit(here, page("/", "[::1]:8460")).status, 200U);
  EXPECT_EQ(admit(here, socket("127.0.0.1:8460", "http://127.0.0.1:8460")).status, 200U);
  EXPECT_EQ(admit(here, socket("127.0.0.1:8460", "")).status, 200U);  // not a browser: sends no origin
}

TEST(LiveAdmission, AnswersNothingButGet) {
  for (const std::string_view method : {"POST", "PUT", "DELETE", "OPTIONS", "HEAD", "CONNECT", "get"}) {
    Asked asked = page();
    asked.method = method;
    EXPECT_EQ(admit(here, asked).status, 405U) << method;
  }
}

TEST(LiveAdmission, RefusesPagesOfOtherSites) {
  for (const std::string_view origin :
       {"http://example.com", "https://127.0.0.1:8460", "http://127.0.0.1:80", "http://127.0.0.1:84600",
        "null", "http://127.0.0.1:8460.example.com"}) {
    EXPECT_EQ(admit(here, socket("127.0.0.1:8460", origin)).status, 403U) << origin;
    EXPECT_EQ(admit(here, page("/", "127.0.0.1:8460", origin)).status, 403U) << origin;
  }
  // A foreign host name that resolves to this machine; the browser then regards the request as same-origin.
  EXPECT_EQ(admit(here, socket("evil.example:8460", "http://evil.example:8460")).status, 421U);
  EXPECT_EQ(admit(here, page("/", "127.0.0.1:80")).status, 421U);
  EXPECT_EQ(admit(here, page("/", "")).status, 400U);
}

TEST(LiveAdmission, WantsTheTokenForEverything) {
  EXPECT_EQ(everywhere.url(), "http://bench:8460/?token=0123abcd");
  for (const std::string_view target :
       {"/", "/?token=", "/?token=0123abce", "/?token=0123abcdd", "/?token=0123abc", "/chart.js",
        "/?Token=0123abcd", "/?x&token=0123abcd"})
    EXPECT_EQ(admit(everywhere, page(target, "bench:8460")).status, 403U) << target;
  EXPECT_EQ(admit(everywhere, page("/?token=0123abcd", "10.0.0.7:8460")).status, 200U);
  EXPECT_EQ(admit(everywhere, page("/script.js?token=0123abcd", "bench:8460")).what, "/script.js");
}

TEST(LiveAdmission, KnowsOneWebSocket) {
  Asked asked = page("/live");
  EXPECT_EQ(admit(here, asked).status, 426U);
  asked = page("/");
  asked.upgrade = true;
  EXPECT_EQ(admit(here, asked).status, 404U);
}

TEST(LiveAdmission, ATokenIsNeverTheSame) {
  const std::string one = new_token();
  EXPECT_EQ(one.size(), 32U);
  EXPECT_NE(one, new_token());
}

}  // namespace
}  // namespace canhil::live
