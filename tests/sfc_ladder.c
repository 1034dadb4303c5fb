/* SPDX-License-Identifier: MIT
 *
 * sfc_ladder - a chart and the ladder made from it do the same in each scan.
 *
 *   sfc_ladder                          some of both: all of ladders/
 *   sfc_ladder --seed S --count N
 *   sfc_ladder FILE.rung …
 *
 * Random charts, and files, on random inputs and times. Charts without a ladder (LD460)
 * are counted. sfc_differential checks charts themselves.
 */
#include "engine/ladder.h"
#include "engine/base/file.h"
#include "tests/tap.h"
#include "tests/walker/random_sfc.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>

#define TEXT_MAX (128 * 1024)
#define SCANS 60

#ifndef DIFFERENTIAL_COUNT
#define DIFFERENTIAL_COUNT 20000
#endif

struct side {
	struct ladder *ladder;
	void *memory;
	struct resource resource;
};

static void close_side(struct side *side)
{
	free(side->memory);
	ladder_free(side->ladder);
	side->memory = NULL;
}

static void say_why(struct ladder *ladder)
{
	char line[400];

	for (int i = 0; i < ladder_diags(ladder)->count; i++) {
		diag_print(&ladder_diags(ladder)->diag[i], line, sizeof(line));
		if (diag_severity(ladder_diags(ladder)->diag[i].id) == SEVERITY_ERROR) {
			printf("# %s\n", line);
			break;
		}
	}
}

static bool open_side(struct side *side, const char *text, size_t len)
{
	*side = (struct side){ .ladder = ladder_new() };
	if (!side->ladder)
		abort();
	if (!ladder_load_text(side->ladder, "chart.rung", text, len) ||
	    !ladder_build(side->ladder))
		return false;
	side->memory = calloc(1, image_memory_size(ladder_program(side->ladder)));
	if (!side->memory)
		abort();
	resource_init(&side->resource, ladder_program(side->ladder), side->memory);
	resource_start(&side->resource);
	return true;
}

/* ---- one pair ---- */

static bool is_same(struct side *chart, struct side *ladder, const char *name,
		    const char *other, bool must)
{
	const struct location a = image_find(&chart->resource.image, name, strlen(name));
	const struct location b = image_find(&ladder->resource.image, other, strlen(other));

	if (a.type == IEC_NONE)
		return true;
	if (b.type == IEC_NONE)
		return !must;
	return a.type == b.type && image_get(&chart->resource.image, a).i ==
	       image_get(&ladder->resource.image, b).i;
}

static int sfcs(const struct project *project)
{
	int count = 0;

	for (int i = 0; i < project->pou_count; i++)
		count += project->pou[i].sfc != NULL;
	return count;
}

/* Whether an earlier chart has a step of this name; then the ladder adds a number to it. */
static bool is_second(struct side *ladder, const struct project *project,
		      const struct pou *pou, const char *name)
{
	char second[320];

	for (const struct pou *at = project->pou; at < pou; at++)
		if (at->sfc) {
			snprintf(second, sizeof(second), "%.300s_2", name);
			return image_find(&ladder->resource.image, second,
					  strlen(second)).type != IEC_NONE;
		}
	return false;
}

/* Compares everything declared; NULL: the same. */
static const char *differs(struct side *chart, struct side *ladder)
{
	const struct project *project = ladder_project(chart->ladder);
	static char name[300];
	char other[320];

	for (int p = -1; p < project->pou_count; p++) {
		const struct pou *pou = p < 0 ? NULL : &project->pou[p];
		const struct var_table *table = pou ? &pou->vars : &project->globals;

		for (int i = 0; i < table->count; i++) {
			const struct var *var = &table->var[i];
			const bool hidden = vars_flags(table, i) & VAR_SFC;
			char *dot;

			snprintf(name, sizeof(name), "%s",
				 project_text(project, var->name));
			snprintf(other, sizeof(other), "%s", name);
			dot = hidden ? strchr(other, '.') : NULL;
			if (hidden && !dot)
				continue; /* TRANSITION */
			if (dot)
				*dot = '_';
			if (dot && is_second(ladder, project, pou, other))
				snprintf(other + strlen(other), sizeof(other) - strlen(other),
					 "_2");
			else if (dot && dot[1] == 'T' && sfcs(project) > 1)
				continue; /* it may be that of the other chart */
			if (!dot && pou && pou->sfc && sfcs(project) > 1)
				snprintf(other, sizeof(other), "%s_%.200s",
					 project_text(project, pou->name), name);
			if (pou && sfcs(project) > 1)
				snprintf(name, sizeof(name), "%s.%s",
					 project_text(project, pou->name),
					 project_text(project, var->name));
			if (var->type != IEC_NONE && !var->array.count &&
			    !is_same(chart, ladder, name, other,
				     !dot || dot[1] == 'X'))
				return name;
		}
	}
	return NULL;
}

static void set_byte(struct side *side, int byte, uint8_t value)
{
	char name[20];
	struct location at;

	snprintf(name, sizeof(name), "%%IB%d", byte);
	at = image_find(&side->resource.image, name, strlen(name));
	if (at.type != IEC_NONE)
		image_set(&side->resource.image, at, (union iec_value){ .i = value });
}

static void change(struct random_source *source, uint8_t *inputs, bool calm)
{
	for (int i = 0; i < 6; i++)
		if (random_chance(source, 60))
			inputs[0] ^= (uint8_t)(1u << random_below(source, 8));
	for (int i = 0; i < 5; i++)
		if (random_chance(source, inputs[1] >> i & 1 || i == 4 ? 40 : calm ? 8 : 4))
			inputs[1] ^= (uint8_t)(1u << i);
	if (random_chance(source, 4))
		inputs[2] = (uint8_t)random_below(source, 24);
}

/* False, with the place, if they differ in a scan. */
static bool run_both(struct side *chart, struct side *ladder, uint64_t seed, int scans)
{
	struct random_source source;
	uint8_t inputs[3] = { 0, 0, 0 };
	int64_t now = 0;

	random_seed(&source, seed);
	for (int scan = 1; scan <= scans; scan++) {
		bool good, other;
		const char *name;

		change(&source, inputs, scans > SCANS);
		now += random_chance(&source, 20) ?
		       (int64_t)random_below(&source, 60000000) :
		       random_chance(&source, 3) ? 500000000 : 10000000;
		for (int i = 0; i < 3; i++) {
			set_byte(chart, i, inputs[i]);
			set_byte(ladder, i, inputs[i]);
		}
		good = resource_scan(&chart->resource, now);
		other = resource_scan(&ladder->resource, now);
		name = good && other ? differs(chart, ladder) : NULL;
		if (good != other || name) {
			printf("# scan %d: %s\n", scan, name ? name : "a fault");
			return false;
		}
		if (!good)
			return true;
	}
	return true;
}

enum verdict { SAME, DIFFERENT, NO_CHART, NO_LADDER };

static enum verdict judge(const char *text, size_t len, uint64_t seed, int scans)
{
	struct diag_list *diags = calloc(1, sizeof(*diags));
	struct side chart, ladder = { .memory = NULL };
	enum verdict verdict = NO_CHART;
	char *made = NULL;
	size_t size;

	if (!diags)
		abort();
	diag_init(diags);
	if (open_side(&chart, text, len)) {
		made = ladder_export_ladder(chart.ladder, &size, diags);
		verdict = made ? DIFFERENT : NO_LADDER;
	}
	if (made && !open_side(&ladder, made, size))
		say_why(ladder.ladder);
	else if (made && run_both(&chart, &ladder, seed, scans))
		verdict = SAME;
	if (verdict == NO_LADDER &&
	    (diags->count != 1 || diags->diag[0].id != DIAG_SFC_NO_LADDER))
		verdict = DIFFERENT;
	free(made);
	free(diags);
	close_side(&chart);
	close_side(&ladder);
	return verdict;
}

static void run_random(uint64_t seed, uint64_t count)
{
	static struct random_sfc chart;
	static char text[TEXT_MAX];
	unsigned int tally[NO_LADDER + 1] = { 0 };

	for (uint64_t i = 0; i < count; i++) {
		enum verdict verdict;
		size_t len;

		memset(&chart, 0, sizeof(chart));
		chart.seed = seed + i;
		len = random_sfc_print(&chart, text, sizeof(text));
		verdict = judge(text, len, chart.seed, SCANS);
		if (verdict == DIFFERENT && tally[DIFFERENT] < 5)
			printf("# --seed %llu --count 1\n", (unsigned long long)chart.seed);
		if (verdict == DIFFERENT && count == 1)
			printf("%s", text);
		tally[verdict]++;
	}
	printf("# %u the same, %u different, %u without a ladder, %u no charts\n",
	       tally[SAME], tally[DIFFERENT], tally[NO_LADDER], tally[NO_CHART]);
	CHECK_AS(tally[DIFFERENT] == 0, "random charts do the same as ladders");
	CHECK_AS(tally[SAME] * 3 > count, "most random charts have a ladder");
}

static void run_file(const char *path, uint64_t seeds, int scans)
{
	size_t len;
	char *text = file_read(path, LIMIT_TEXT, &len, NULL);
	bool good = true;

	if (!text)
		abort();
	for (uint64_t seed = 1; good && seed <= seeds; seed++)
		good = judge(text, len, seed, scans) == SAME;
	CHECK_AS(good, path);
	free(text);
}

/* More steps than FORCE has numbers: the others cannot be forced. */
static void run_many(void)
{
	static char text[TEXT_MAX];
	size_t len = (size_t)snprintf(text, sizeof(text), "RUNGBOARD 1\nPROGRAM P SFC\n"
		"VAR F AT %%IB2 : SINT; END_VAR\nCONTROL(FORCE := F);\n");

	for (int i = 0; i < 150; i++)
		len += (size_t)snprintf(text + len, sizeof(text) - len,
			"%s S%d:\nEND_STEP\nTRANSITION FROM S%d TO S%d := I0.%d; "
			"END_TRANSITION\n", i ? "STEP" : "INITIAL_STEP", i, i,
			(i + 1) % 150, i % 8);
	len += (size_t)snprintf(text + len, sizeof(text) - len, "END_PROGRAM\n");
	CHECK_AS(judge(text, len, 1, 200) == SAME, "a SINT that forces 127 of 150 steps");
}

static void run_folder(const char *folder)
{
	DIR *dir = opendir(folder);
	const struct dirent *entry;
	char path[512];
	int count = 0;

	while (dir && (entry = readdir(dir))) {
		const char *dot = strrchr(entry->d_name, '.');

		if (!dot || strcmp(dot, ".rung") != 0)
			continue;
		snprintf(path, sizeof(path), "%s/%s", folder, entry->d_name);
		run_file(path, 2, 1000);
		count++;
	}
	if (dir)
		closedir(dir);
	CHECK_AS(count > 5, "samples were found");
}

int main(int argc, char **argv)
{
	uint64_t seed = 1, count = DIFFERENTIAL_COUNT / 40;
	int at = 1;

	for (; at + 1 < argc && argv[at][0] == '-'; at += 2) {
		if (strcmp(argv[at], "--seed") == 0)
			seed = strtoull(argv[at + 1], NULL, 10);
		else
			count = strtoull(argv[at + 1], NULL, 10);
	}
	for (int i = at; i < argc; i++)
		run_file(argv[i], 20, 4000);
	if (at == argc)
		run_random(seed, count);
	if (argc == 1)
		run_folder("ladders");
	if (argc == 1)
		run_many();
	return tap_done();
}
