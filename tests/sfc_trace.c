/* SPDX-License-Identifier: MIT
 *
 * sfc_trace - the walker plays the golden cases sfc-*; its trace must equal the
 * expected one byte by byte, so that two evaluators agree on it.
 *
 *   sfc_trace           all of tests/golden/sfc-*
 *   sfc_trace DIR       prints the walker's trace of one
 *
 * It supports the parts of a stimulus that these cases use: inputs by name, `.`,
 * @print, @period, +ms and xN. It compares only BOOL, TIME and whole numbers.
 */
#include "engine/ladder.h"
#include "tests/tap.h"
#include "tests/walker/walker.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define TEXT_MAX (64 * 1024)
#define SHOWN 24

struct player {
	struct ladder *ladder;
	struct walker *walker;
	int shown[SHOWN], shown_count;
	char name[SHOWN][64];
	int64_t now_ns, period_ns;
	int scan;
	bool failed;      /* a scan                                           */
	char out[TEXT_MAX];
	size_t used;
	char why[128];    /* the text that was not understood                 */
};

static size_t slurp(const char *dir, const char *name, char *out)
{
	char path[512];
	FILE *file;
	size_t len;

	snprintf(path, sizeof(path), "%s/%s", dir, name);
	file = fopen(path, "rb");
	len = file ? fread(out, 1, TEXT_MAX - 1, file) : 0;
	if (file)
		fclose(file);
	out[len] = '\0';
	return len;
}

/* A global, or a variable with the name of its program before it. */
static int find(const struct player *player, const char *name)
{
	for (int i = 0; i < walker_count(player->walker); i++) {
		const char *at = walker_name(player->walker, i), *dot = strchr(at, '.');

		if (strcasecmp(at, name) == 0 || (dot && strcasecmp(dot + 1, name) == 0))
			return i;
	}
	return -1;
}

static const struct var *find_input(const struct player *player, const char *name)
{
	const struct project *project = ladder_project(player->ladder);

	for (int p = 0; p < project->pou_count; p++)
		for (int i = 0; i < project->pou[p].vars.count; i++) {
			const struct var *var = &project->pou[p].vars.var[i];

			if (strcasecmp(project_text(project, var->name), name) == 0 &&
			    var->at.area == AREA_I)
				return var;
		}
	return NULL;
}

static void set_input(struct player *player, char *word)
{
	char *value = strchr(word, '=');
	const struct var *var;
	uint8_t *at;
	long number;

	*value++ = '\0';
	number = strtol(value, NULL, 10);
	var = find_input(player, word);
	if (!var) {
		snprintf(player->why, sizeof(player->why), "no input %s", word);
		return;
	}
	at = walker_area(player->walker, AREA_I) + var->at.byte;
	if (var->type == IEC_BOOL)
		*at = (uint8_t)((*at & ~(1u << var->at.bit)) |
				((unsigned)(number != 0) << var->at.bit));
	else
		for (int i = 0; i < iec_type_row(var->type)->size; i++)
			at[i] = (uint8_t)(number >> 8 * i);
}

static void say(struct player *player, const char *text)
{
	player->used += (size_t)snprintf(player->out + player->used,
					 TEXT_MAX - player->used, "%s", text);
	if (player->used >= TEXT_MAX)
		player->used = TEXT_MAX - 1;
}

static void show(struct player *player)
{
	char text[160];

	snprintf(text, sizeof(text), "%d t=%lld", player->scan,
		 (long long)player->now_ns / 1000000);
	say(player, text);
	for (int i = 0; i < player->shown_count; i++) {
		struct value value = walker_value(player->walker, player->shown[i]);

		snprintf(text, sizeof(text), " %s=%lld", player->name[i],
			 (long long)(value.type == IEC_TIME ? value.i / 1000000 : value.i));
		say(player, text);
	}
	say(player, "\n");
}

static void scan(struct player *player, int64_t step_ns, long repeat)
{
	for (long i = 0; i < repeat && !player->failed; i++) {
		player->now_ns += step_ns;
		player->scan++;
		player->failed = !walker_scan(player->walker, player->now_ns);
		if (!player->failed)
			show(player);
	}
}

static void choose_shown(struct player *player, char *word)
{
	int found = find(player, word);

	if (found < 0 || player->shown_count == SHOWN) {
		snprintf(player->why, sizeof(player->why), "cannot show %s", word);
		return;
	}
	snprintf(player->name[player->shown_count], sizeof(player->name[0]), "%s", word);
	player->shown[player->shown_count++] = found;
}

static void play_line(struct player *player, char *line)
{
	int64_t step_ns = player->period_ns;
	char *rest, *word = strtok_r(line, " \t", &rest);
	bool print = word && strcmp(word, "@print") == 0;
	bool period = word && strcmp(word, "@period") == 0;
	long repeat = 1;

	if (!word || *word == '#')
		return;
	if (print)
		player->shown_count = 0;
	if (print || period)
		word = strtok_r(NULL, " \t", &rest);
	for (; word && *word != '#'; word = strtok_r(NULL, " \t", &rest)) {
		if (print)
			choose_shown(player, word);
		else if (period)
			player->period_ns = strtoll(word, NULL, 10) * 1000000;
		else if (strchr(word, '='))
			set_input(player, word);
		else if (*word == '+')
			step_ns = strtoll(word + 1, NULL, 10) * 1000000;
		else if (*word == 'x')
			repeat = strtol(word + 1, NULL, 10);
		else if (strcmp(word, ".") != 0)
			snprintf(player->why, sizeof(player->why), "%.100s ?", word);
	}
	if (!print && !period)
		scan(player, step_ns, repeat);
}

static void play_script(struct player *player, char *text)
{
	char *rest;

	for (char *line = strtok_r(text, "\n", &rest); line && !player->failed;
	     line = strtok_r(NULL, "\n", &rest))
		play_line(player, line);
}

/* The walker's trace of a case; false with a reason if there is none. */
static bool play(const char *dir, struct player *player)
{
	static char text[TEXT_MAX];
	const char *why = "is not read";
	size_t len = slurp(dir, "main.rung", text);

	memset(player, 0, sizeof(*player));
	player->period_ns = 10000000;
	player->ladder = ladder_new();
	if (player->ladder && ladder_load_text(player->ladder, "main.rung", text, len) &&
	    ladder_build(player->ladder))
		player->walker = walker_new(ladder_project(player->ladder), &why);
	if (player->walker) {
		slurp(dir, "stimulus", text);
		play_script(player, text);
	} else {
		snprintf(player->why, sizeof(player->why), "%s", why);
	}
	walker_free(player->walker);
	ladder_free(player->ladder);
	return !*player->why;
}

/* A trace that ends with a fault has a message after it. */
static bool is_expected(const char *dir, const struct player *player)
{
	static char text[TEXT_MAX];

	if (!player->failed)
		return slurp(dir, "expected.trace", text) == player->used &&
		       strcmp(text, player->out) == 0;
	return slurp(dir, "expected.fault", text) > player->used &&
	       strncmp(text, player->out, player->used) == 0;
}

static int compare_names(const void *a, const void *b)
{
	return strcmp(*(char *const *)a, *(char *const *)b);
}

static int check_all(void)
{
	static struct player player;
	static char *name[2000];
	DIR *dir = opendir("tests/golden");
	int count = 0, played = 0;
	char path[300];

	for (struct dirent *at; dir && (at = readdir(dir)) != NULL; )
		if (strncmp(at->d_name, "sfc-", 4) == 0 && count < 2000)
			name[count++] = strdup(at->d_name);
	if (dir)
		closedir(dir);
	qsort(name, (size_t)count, sizeof(*name), compare_names);
	for (int i = 0; i < count; i++) {
		bool good;

		snprintf(path, sizeof(path), "tests/golden/%s", name[i]);
		good = play(path, &player) && is_expected(path, &player);
		CHECK_AS(good, name[i]);
		if (!good)
			printf("# %s\n", *player.why ? player.why : "the trace differs");
		played += good;
		free(name[i]);
	}
	CHECK_AS(played > 0, "some golden cases have charts");
	return tap_done();
}

int main(int argc, char **argv)
{
	static struct player player;

	if (argc < 2)
		return check_all();
	if (!play(argv[1], &player))
		printf("%s\n", player.why);
	fputs(player.out, stdout);
	return *player.why != '\0';
}
