/* SPDX-License-Identifier: MIT
 *
 * loops - the programs of st/ in C, without any check of bounds and results. bench.sh compiles it with -O2
 * and prints both.
 *
 * It prints lines NAME NS: the median of 101 rounds, of one scan.
 */
#include <stdint.h>
#include <stdio.h>
#include <time.h>

int16_t i, j, s, t, state, count, a[1000], b[1000];
float r, wanted = 50, actual, error, before, sum, out;

static void body_int(void)
{
	for (i = 1; i <= 1000; i++)
		s = (int16_t)((s + i * 3) % 1000);
}

static void body_real(void)
{
	for (i = 1; i <= 1000; i++)
		r = r * 0.5f + 1.25f;
}

static void body_product(void)
{
	s = 0;
	for (i = 0; i <= 999; i++)
		s = (int16_t)(s + a[i] * b[i]);
	a[7] = 3;
	b[7] = 5;
}

static void body_sort(void)
{
	for (i = 0; i <= 99; i++)
		a[i] = (int16_t)(i * 37 % 101);
	for (i = 0; i <= 98; i++)
		for (j = 0; j <= 98 - i; j++)
			if (a[j] > a[j + 1]) {
				t = a[j];
				a[j] = a[j + 1];
				a[j + 1] = t;
			}
}

#define STATE(n) \
	case n: \
		count = (int16_t)(count + 1 + (n) % 3); \
		if (count > 5 + (n) % 7) { \
			count = 0; \
			state = ((n) + 1) % 50; \
		} \
		break;
#define TEN(n) STATE(n + 0) STATE(n + 1) STATE(n + 2) STATE(n + 3) STATE(n + 4) \
	       STATE(n + 5) STATE(n + 6) STATE(n + 7) STATE(n + 8) STATE(n + 9)

static void body_states(void)
{
	switch (state) {
	TEN(0) TEN(10) TEN(20) TEN(30) TEN(40)
	}
}

static void body_pid(void)
{
	error = wanted - actual;
	sum = sum + error * 0.01f;
	if (sum > 100)
		sum = 100;
	else if (sum < -100)
		sum = -100;
	out = 2 * error + 0.5f * sum + 0.1f * (error - before) / 0.01f;
	if (out > 100)
		out = 100;
	else if (out < 0)
		out = 0;
	before = error;
	actual = actual + (out - actual) * 0.05f;
}

static double now_ns(void)
{
	struct timespec now;

	clock_gettime(CLOCK_MONOTONIC, &now);
	return (double)now.tv_sec * 1e9 + (double)now.tv_nsec;
}

/* @scans: of a round. */
static void measure(const char *name, void (*body)(void), int scans)
{
	double took[101];

	for (int round = 0; round < 101; round++) {
		double begin = now_ns();

		for (int scan = 0; scan < scans; scan++)
			body();
		took[round] = (now_ns() - begin) / scans;
		for (int k = round; k > 0 && took[k] < took[k - 1]; k--) {
			double more = took[k - 1];

			took[k - 1] = took[k];
			took[k] = more;
		}
	}
	printf("%s %.2f\n", name, took[50]);
}

int main(void)
{
	/* A compiler cannot know which function a volatile pointer calls. */
	static const struct { const char *name; void (*volatile body)(void); int scans; } all[] = {
		{ "int", body_int, 20 }, { "real", body_real, 20 }, { "product", body_product, 20 },
		{ "sort", body_sort, 5 }, { "states", body_states, 5000 }, { "pid", body_pid, 5000 },
	};

	for (unsigned int k = 0; k < sizeof(all) / sizeof(*all); k++)
		measure(all[k].name, all[k].body, all[k].scans);
	return 0;
}
