/* A turntable that turns at the commanded rate, as a program in C99 that hil-bench drives (docs/plant-program.md).
   Build it with: cc -o turntable turntable.c */
#include <stdio.h>
#include <string.h>

int main(void) {
  char line[1000];
  double angle = 0, largest = 1e9; /* rad, rad/s */
  long long from_us, to_us;

  setvbuf(stdout, NULL, _IOLBF, 0); /* each line is sent at its end */
  while (fgets(line, sizeof line, stdin) != NULL && strcmp(line, "start\n") != 0)
    sscanf(line, "number largest_radps %lf", &largest); /* other lines are skipped */
  printf("input rate rad/s\noutput attitude.heading rad turns\nstate %.17g\n", angle);
  while (fgets(line, sizeof line, stdin) != NULL) {
    double rate;
    if (sscanf(line, "step %lld %lld %lf", &from_us, &to_us, &rate) != 3) break; /* end */
    if (rate > largest) rate = largest;
    if (rate < -largest) rate = -largest;
    angle += rate * 1e-6 * (double)(to_us - from_us);
    printf("state %.17g\n", angle);
  }
  return 0;
}
