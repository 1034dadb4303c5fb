/* SPDX-License-Identifier: MIT
 *
 * ladder_random - a random ladder that can be exported to ClassicLadder, and a script.
 *
 *   ladder_random SEED NAME     writes NAME.rung and NAME.script
 *
 * The result of `ladder export` must run as the ladder does. The script prints variables by
 * their names in the rung file.
 */
#include "tests/classic/ladder_words.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static FILE *open_beside(const char *name, const char *end)
{
	char path[1000];
	FILE *file;

	snprintf(path, sizeof(path), "%s%s", name, end);
	file = fopen(path, "w");
	if (!file)
		perror(path);
	return file;
}

/* Replaces STOP, EXECUTE and the loop that random.c makes; NULL: unchanged. */
static const char *in_its_place(const char *text)
{
	if (!strcmp(text, "STOP"))
		return "RET";
	if (!strncmp(text, "EXECUTE", 7))
		return "[ num_b := num_b + 1 ]";
	if (strncmp(text, "[ loop_", 7) != 0)
		return NULL;
	if (strchr(text, '<'))
		return "[ num_b < 3 ]";
	return strstr(text, ":= 0") ? "[ num_b := 0 ]" : "[ num_b := num_b + 1 ]";
}

/* Leaves out what ClassicLadder does not have: function blocks of one's own, STOP, EXECUTE, loops. */
static void leave_out(struct random_program *program)
{
	while (program->rungs && program->rung[program->rungs - 1].pou > RANDOM_OTHER)
		program->rungs--;
	for (int i = 0; i < program->rungs; i++)
		for (int k = 0; k < RANDOM_ROWS * RANDOM_COLS; k++) {
			char *text = program->rung[i].cell[k / RANDOM_COLS]
							  [k % RANDOM_COLS].text;

			const char *other = in_its_place(text);

			if (other)
				snprintf(text, RANDOM_TEXT, "%s", other);
		}
	program->sized = false;
}

/* Most second calls of an instance become calls of another one. */
static void name_calls(struct random_source *source, struct random_program *program)
{
	int calls[32] = { 0 };

	for (int i = 0; i < program->rungs * RANDOM_ROWS * RANDOM_COLS; i++) {
		int at = i % (RANDOM_ROWS * RANDOM_COLS);
		char *text = program->rung[i / (RANDOM_ROWS * RANDOM_COLS)]
				     .cell[at / RANDOM_COLS][at % RANDOM_COLS].text;
		char *name = strchr(text, ' '), *end = name ? name + 1 + strcspn(name + 1, " ") :
			     NULL;
		size_t which = 0;

		if (!name || *text == '[' || end - name < 4 || end[-1] != 'a' || end[-2] != '_' ||
		    !random_block(name + 1, (size_t)(end - name - 1), &which))
			continue;
		if (random_chance(source, 95))
			end[-1] = (char)('a' + calls[which]++ % 26);
	}
}

static void write_script(struct random_source *source, const char *text, FILE *file)
{
	static const int period[] = { 50, 50, 10, 100, 30, 20 };
	const char *at = strstr(text, "VAR\n"), *end = strstr(text, "END_VAR");

	fprintf(file, "@period %d\n@print %%Q7..8", period[random_below(source, 6)]);
	for (at = at ? strchr(at, '\n') + 1 : end; at && at < end; at = strchr(at, '\n') + 1) {
		const char *type = strchr(at, ':');

		at += strspn(at, " ");
		if (type && (!strncmp(type, ": BOOL", 6) || !strncmp(type, ": DINT", 6) ||
			     !strncmp(type, ": INT", 5) || !strncmp(type, ": UINT", 6)))
			fprintf(file, " %.*s", (int)strcspn(at, " "), at);
	}
	fprintf(file, "\n");
	for (int i = 0; i < 90; i++) {
		if (random_chance(source, 60))
			fprintf(file, "%%I%d=%d ", (int)random_below(source, 6),
				(int)random_below(source, 2));
		if (random_chance(source, 10))
			fprintf(file, "%%I15=%d ", (int)random_below(source, 2));
		fprintf(file, ". x%d\n", random_chance(source, 70) ? 1 :
			1 + (int)random_below(source, 12));
	}
}

int main(int argc, char **argv)
{
	static struct random_program program;
	static char text[128 * 1024];
	struct random_source source;
	FILE *rung, *script;
	unsigned long long seed = argc > 1 ? strtoull(argv[1], NULL, 10) : 0;

	if (argc < 3) {
		fprintf(stderr, "usage: ladder_random SEED NAME\n");
		return 2;
	}
	rung = open_beside(argv[2], ".rung");
	script = open_beside(argv[2], ".script");
	if (!rung || !script)
		return 1;
	random_make(&program, seed);
	random_seed(&source, seed + 1);
	leave_out(&program);
	name_calls(&source, &program);
	random_print(&program, text, sizeof(text));
	fputs(text, rung);
	write_script(&source, text, script);
	return fclose(rung) | fclose(script);
}
