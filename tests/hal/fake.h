/* SPDX-License-Identifier: MIT
 *
 * fake - chips that exist in a test only.
 *
 * fake_v1.c and fake_v2.c implement the calls of libgpiod with them, fake_uapi.c those of
 * the kernel. The suite sets up chips, counts calls and makes them fail.
 */
#ifndef TESTS_HAL_FAKE_H
#define TESTS_HAL_FAKE_H

#include <stdbool.h>
#include <stddef.h>

#define FAKE_CHIPS 4
#define FAKE_LINES 200
#define FAKE_MOST  64    /* lines of a request */

struct fake_line {
	const char *name, *owner; /* NULL: none                             */
	bool used, output, active_low;
	int level;
	char bias, drive;         /* - u d n, - o s                         */
};

struct fake_chip {
	const char *label;
	unsigned int lines;
	bool present;
	int open_error;           /* errno of opening it                    */
	int generation;           /* rises when it is unplugged             */
	struct fake_line line[FAKE_LINES];
};

struct fake_request {
	struct fake_chip *chip;
	int generation;
	unsigned int offset[FAKE_MOST];
	size_t count;
	bool output;
};

struct fake {
	struct fake_chip chip[FAKE_CHIPS];
	char calls[256];          /* o c: chip; I O x: request; r w         */
	size_t call_count;
	int reads, writes, takes, releases, opens, closes;
	int read_error, write_error, take_error; /* errno, until 0          */
	int settings;             /* objects of libgpiod that are not freed */
	int good_calls;           /* that many calls until one fails; 0: none fails */
	int call_error;           /* errno of that call                     */
	bool call_failed;         /* it was made                            */
};
extern struct fake fake;

void fake_reset(void);
void fake_clear_calls(void);
void fake_unplug(int chip);
/* Objects of libgpiod: one more, one fewer. */
void fake_settings(int more);
/* A line as it is now; another thread may be at it. */
struct fake_line fake_line(const struct fake_chip *chip, unsigned int offset);
/* Whether this call is the one that fails; then errno is set. */
bool fake_fails(void);

/* Memory of a fake, all zero. It is not from malloc() or calloc(), of which a test may give too little. */
void *fake_new(size_t size);
/* The work of a libgpiod. Return -1 and set errno on failure. */
struct fake_chip *fake_open(const char *path);
void fake_close(void);
int fake_take(struct fake_request *request, struct fake_chip *chip,
	      const char *owner, const int *values, const char *bias,
	      const char *drive);
void fake_release(struct fake_request *request);
int fake_read(const struct fake_request *request, int *values);
int fake_write(const struct fake_request *request, const int *values);
/* Called at each read, if a test sets it; see daemon_fake.c. */
extern void (*fake_at_read)(void);
extern void (*fake_at_open)(void);
extern void (*fake_at_write)(void);
#endif
