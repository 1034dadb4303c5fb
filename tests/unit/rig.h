/* SPDX-License-Identifier: MIT
 *
 * rig - a small program, built and scanned, with its variables by name.
 *
 * For tests of scan/ and translate/. Time moves 10 ms a scan. A program that does
 * not build prints why and is checked as a failure; then nothing else of it runs.
 */
#ifndef TESTS_RIG_H
#define TESTS_RIG_H

#include "engine/ladder.h"
#include "tests/tap.h"

#include <stdlib.h>

#define RIG_PERIOD INT64_C(10000000)

struct rig {
	struct ladder *ladder;
	void *memory;
	struct resource resource;
	int64_t now;
	bool good;
};

static inline void rig_say_why(struct ladder *ladder)
{
	const struct diag_list *diags = ladder_diags(ladder);
	char line[400];

	for (int i = 0; i < diags->count; i++) {
		diag_print(&diags->diag[i], line, sizeof(line));
		printf("# %s\n", line);
	}
}

/* @text: the file without its first line. */
static inline bool rig_open(struct rig *rig, const char *text, bool watch)
{
	size_t size = strlen(text) + 32;
	char *file = malloc(size);

	memset(rig, 0, sizeof(*rig));
	rig->ladder = ladder_new();
	if (!file || !rig->ladder)
		abort();
	snprintf(file, size, "RUNGBOARD 1\n%s", text);
	ladder_watch(rig->ladder, watch);
	rig->good = ladder_load_text(rig->ladder, "rig.rung", file,
				     strlen(file)) && ladder_build(rig->ladder);
	free(file);
	if (!CHECK_AS(rig->good, "the program builds")) {
		rig_say_why(rig->ladder);
		return false;
	}
	rig->memory = calloc(1, image_memory_size(ladder_program(rig->ladder)));
	if (!rig->memory)
		abort();
	resource_init(&rig->resource, ladder_program(rig->ladder), rig->memory);
	rig->resource.watch = watch;
	resource_start(&rig->resource);
	return true;
}

static inline void rig_close(struct rig *rig)
{
	free(rig->memory);
	ladder_free(rig->ladder);
}

static inline bool rig_scan(struct rig *rig)
{
	rig->now += RIG_PERIOD;
	return rig->good && resource_scan(&rig->resource, rig->now);
}

static inline struct location rig_at(struct rig *rig, const char *name)
{
	struct location none = { .type = IEC_NONE };
	struct location at = rig->good ? image_find(&rig->resource.image, name,
						    strlen(name)) : none;

	if (at.type == IEC_NONE)
		printf("# no variable %s\n", name);
	return at;
}

static inline int64_t rig_get(struct rig *rig, const char *name)
{
	struct location at = rig_at(rig, name);

	return at.type == IEC_NONE ? INT64_MIN :
	       image_get(&rig->resource.image, at).i;
}

static inline double rig_real(struct rig *rig, const char *name)
{
	return image_get(&rig->resource.image, rig_at(rig, name)).r;
}

static inline bool rig_set(struct rig *rig, const char *name, int64_t value)
{
	struct location at = rig_at(rig, name);

	return at.type != IEC_NONE &&
	       image_set(&rig->resource.image, at,
			 (union iec_value){ .i = value });
}

static inline bool rig_force(struct rig *rig, const char *name, int64_t value)
{
	return image_force(&rig->resource.image, rig_at(rig, name),
			   (union iec_value){ .i = value });
}

static inline bool rig_release(struct rig *rig, const char *name)
{
	return image_unforce(&rig->resource.image, rig_at(rig, name));
}
#endif
