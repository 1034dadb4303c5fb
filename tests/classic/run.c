/* SPDX-License-Identifier: MIT
 *
 * run - runs scripts with the second evaluator and prints traces.
 */
#include "tests/classic/run.h"
#include "tests/classic/engine.h"
#include "tests/classic/own_read.h"

#include <stdlib.h>
#include <string.h>

enum { SHOWN = 2000, WORD = 64 };

struct shown {
	int type[SHOWN], number[SHOWN];
	int32_t before[SHOWN];
	int count;
};

char *load_text(const char *path)
{
	FILE *file = fopen(path, "rb");
	size_t size = 1 << 20, len = 0;
	char *text = file ? malloc(size + 1) : NULL;

	if (text) {
		len = fread(text, 1, size, file);
		text[len] = '\0';
	} else {
		perror(path);
	}
	if (file)
		fclose(file);
	return text;
}

bool load_project(struct loaded *loaded, const char *path)
{
	arena_init(&loaded->arena);
	loaded->project = own_read(&loaded->arena, path);
	if (loaded->project)
		return true;
	fprintf(stderr, "%s: cannot read it\n", path);
	unload_project(loaded);
	return false;
}

void unload_project(struct loaded *loaded)
{
	arena_free(&loaded->arena);
}

/* @word gets the next word of a line. false: there is none. */
static bool next_word(const char **at, char word[WORD])
{
	size_t len;

	*at += strspn(*at, " \t\r");
	len = strcspn(*at, " \t\r\n");
	if (!len)
		return false;
	snprintf(word, WORD, "%.*s", len < WORD ? (int)len : WORD - 1, *at);
	*at += len;
	return true;
}

/* "%Q0..7", "%X2.A", "%TM0.Q". */
static bool show(const struct engine *engine, struct shown *shown, const char *word)
{
	int type, first, last, len = engine_name(engine, word, &type, &first);

	if (!len)
		return false;
	last = strncmp(word + len, "..", 2) == 0 ? atoi(word + len + 2) : first;
	for (int i = first; i <= last && shown->count < SHOWN; i++) {
		shown->type[shown->count] = type;
		shown->before[shown->count] = 0;
		shown->number[shown->count++] = i;
	}
	return true;
}

static void print_line(const struct engine *engine, struct shown *shown, bool changes,
		       int scan, FILE *out)
{
	bool begun = false;

	for (int i = 0; i < shown->count; i++) {
		int32_t value = engine_get(engine, shown->type[i], shown->number[i]);
		char name[40];

		if (changes && value == shown->before[i])
			continue;
		if (!begun)
			fprintf(out, "%d t=%lld", scan, (long long)engine->now);
		begun = true;
		shown->before[i] = value;
		engine_print(engine, shown->type[i], shown->number[i], name, sizeof(name));
		fprintf(out, " %s=%d", name, value);
	}
	if (begun)
		fputc('\n', out);
}

struct line { int times, ms; bool quiet, good; };

static struct line set_values(struct engine *engine, const char *at, int period)
{
	struct line line = { 1, period, false, true };
	char word[WORD];

	while (next_word(&at, word)) {
		int type, number, len = engine_name(engine, word, &type, &number);

		if (len && word[len] == '=')
			engine_set(engine, type, number, (int32_t)strtol(word + len + 1, NULL, 10));
		else if (*word == '+')
			line.ms = atoi(word + 1);
		else if (*word == 'x')
			line.times = atoi(word + 1);
		else if (strcmp(word, "quiet") == 0)
			line.quiet = true;
		else if (strcmp(word, ".") != 0)
			line.good = false;
		if (!line.good) {
			fprintf(stderr, "%s: unknown word\n", word);
			return line;
		}
	}
	return line;
}

static void command(struct engine *engine, struct shown *shown, const char *at, int *period,
		    FILE *out)
{
	char word[WORD];

	next_word(&at, word);
	if (strcmp(word, "@print") == 0) {
		shown->count = 0;
		while (next_word(&at, word))
			show(engine, shown, word);
	} else if (strcmp(word, "@echo") == 0) {
		at += strspn(at, " ");
		fprintf(out, "# %.*s\n", (int)strcspn(at, "\r\n"), at);
	} else if (strcmp(word, "@period") == 0 && next_word(&at, word)) {
		*period = atoi(word);
	}
}

bool run_script(const struct classic_project *project, bool faithful, bool changes,
		const char *script, FILE *out)
{
	struct engine *engine = engine_new(project, faithful);
	struct shown *shown = calloc(1, sizeof(*shown));
	int period = project->period, scan = 0;
	bool good = engine && shown;

	while (good && *script) {
		const char *end = script + strcspn(script, "\n");

		if (*script == '@') {
			command(engine, shown, script, &period, out);
		} else if (*script != '#' && script[strspn(script, " \t\r")] != '\n' &&
			   script[strspn(script, " \t\r")]) {
			char *line_text = malloc((size_t)(end - script) + 1);
			struct line line = { 0 };

			if (line_text) {
				memcpy(line_text, script, (size_t)(end - script));
				line_text[end - script] = '\0';
				line = set_values(engine, line_text, period);
			}
			free(line_text);
			good = line.good;
			for (int i = 0; good && i < line.times; i++) {
				engine_scan(engine, line.ms);
				scan++;
				if (!line.quiet || i == line.times - 1)
					print_line(engine, shown, changes, scan, out);
			}
		}
		script = *end ? end + 1 : end;
	}
	free(shown);
	engine_free(engine);
	return good;
}
