/* SPDX-License-Identifier: MIT
 *
 * real - 1,000 additions and comparisons of REAL in C: the program of `programs.pl real
 * 1000`, with the same checks. bench.sh compiles it with -O2.
 *
 * ROW(n) is one rung. The statements follow each other, as in the ladder. As there, a sum
 * that is not a number is not stored, ENO is FALSE, and it is counted; the ladder also
 * keeps the place of the first one. The boxes are at the left rail, so neither version
 * checks EN.
 */
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <time.h>

#define TEN(x, n)      x(n##0) x(n##1) x(n##2) x(n##3) x(n##4) x(n##5) x(n##6) x(n##7) x(n##8) x(n##9)
#define HUNDRED(x, n)  TEN(x, n##0) TEN(x, n##1) TEN(x, n##2) TEN(x, n##3) TEN(x, n##4) \
		       TEN(x, n##5) TEN(x, n##6) TEN(x, n##7) TEN(x, n##8) TEN(x, n##9)
#define THOUSAND(x)    HUNDRED(x, _0) HUNDRED(x, _1) HUNDRED(x, _2) HUNDRED(x, _3) HUNDRED(x, _4) \
		       HUNDRED(x, _5) HUNDRED(x, _6) HUNDRED(x, _7) HUNDRED(x, _8) HUNDRED(x, _9)

uint32_t errors;
#define DECLARE(n) float a##n = 1.5f, b##n = 0.25f, c##n; uint8_t eno##n, out##n;
THOUSAND(DECLARE)

/* ENO is FALSE and nothing is stored if the sum is not a number. */
static bool add(float a, float b, float *out)
{
	float sum = a + b;

	if (!isfinite(sum)) {
		errors++;
		return false;
	}
	*out = sum;
	return true;
}

#define ROW(n) \
	eno##n = add(a##n, b##n, &c##n); \
	out##n = eno##n & (c##n > a##n);

__attribute__((noinline)) void body(void);
void body(void)
{
	THOUSAND(ROW)
}

static double seconds(void)
{
	struct timespec now;

	clock_gettime(CLOCK_MONOTONIC, &now);
	return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}

/* The median of 101 rounds of 200 runs, in ns per row. */
int main(void)
{
	double took[101];

	for (int round = 0; round < 101; round++) {
		double begin = seconds();

		for (int i = 0; i < 200; i++)
			body();
		took[round] = (seconds() - begin) * 1e9 / 200 / 1000;
		for (int k = round; k > 0 && took[k] < took[k - 1]; k--) {
			double more = took[k - 1];

			took[k - 1] = took[k];
			took[k] = more;
		}
	}
	printf("%.2f\n", took[50]);
	return errors != 0;
}
