/* SPDX-License-Identifier: MIT
 *
 * classic_differential - runs random ClassicLadder projects imported and not imported.
 *
 *   classic_differential [--count N] [--seed S] [--keep FOLDER]
 *
 * `ladder trace` imports a project and runs the result; the second evaluator runs the project
 * itself. Both traces must be the same, with ClassicLadder's faults and without. Every fourth
 * project has elements in places that the editor of ClassicLadder does not allow. FOLDER gets
 * the projects that differ, as NAME.clprj and NAME.script.
 */
#define _POSIX_C_SOURCE 200809L
#include "tests/classic/random_project.h"
#include "tests/classic/run.h"
#include "tests/tap.h"

#include <stdlib.h>
#include <unistd.h>

enum { SHOWN = 5, BATCH = 50 };
#ifdef __SANITIZE_ADDRESS__
#define COUNT 50 /* with sanitizers each import is slow                      */
#else
#define COUNT 300
#endif

struct duel {
	const char *ladder;
	char folder[64];
	const char *keep;
	int differ, told;
};

static bool write_text(const char *folder, const char *name, const char *text)
{
	char path[400];
	FILE *file;

	snprintf(path, sizeof(path), "%s/%s", folder, name);
	file = fopen(path, "w");
	return file && fputs(text, file) >= 0 && fclose(file) == 0;
}

/* What a command prints. Free it with free(). */
static char *printed(const char *command)
{
	FILE *pipe = popen(command, "r");
	size_t len = 0, size = 0;
	char *text = NULL;
	char part[4096];
	size_t got;

	while (pipe && (got = fread(part, 1, sizeof(part), pipe)) > 0) {
		if (len + got >= size) {
			size = (len + got) * 2 + 1;
			text = realloc(text, size);
			if (!text)
				abort();
		}
		memcpy(text + len, part, got);
		len += got;
	}
	if (pipe)
		pclose(pipe);
	if (text)
		text[len] = '\0';
	return text ? text : calloc(1, 1);
}

static char *evaluated(const struct loaded *loaded, bool faithful, const char *script)
{
	char *text = NULL;
	size_t len = 0;
	FILE *memory = open_memstream(&text, &len);

	if (!memory)
		abort();
	run_script(loaded->project, faithful, true, script, memory);
	fclose(memory);
	return text;
}

static void tell(struct duel *duel, unsigned long long seed, bool faithful,
		 const char *got, const char *want)
{
	size_t at = 0, line = 0;

	while (got[at] && got[at] == want[at]) {
		if (got[at] == '\n')
			line = at + 1;
		at++;
	}
	if (duel->told++ < SHOWN)
		printf("# seed %llu%s: differs\n#  ladder: %.*s\n#  itself: %.*s\n", seed,
		       faithful ? ", faithful" : "", (int)strcspn(got + line, "\n"), got + line,
		       (int)strcspn(want + line, "\n"), want + line);
}

static void compare(struct duel *duel, unsigned long long seed, const struct loaded *loaded,
		    bool faithful, const char *script)
{
	char command[800];
	char *want = evaluated(loaded, faithful, script), *got;

	snprintf(command, sizeof(command),
		 "%s trace --changes %s %s/x.clprj %s/x.script 2>%s/x.err || "
		 "grep error %s/x.err || echo it died", duel->ladder,
		 faithful ? "--faithful" : "", duel->folder, duel->folder, duel->folder,
		 duel->folder);
	got = printed(command);
	if (strcmp(got, want) != 0) {
		duel->differ++;
		tell(duel, seed, faithful, got, want);
	}
	free(want);
	free(got);
}

static void keep(const struct duel *duel, unsigned long long seed,
		 const struct random_texts *texts)
{
	char name[60];

	snprintf(name, sizeof(name), "seed-%llu.clprj", seed);
	write_text(duel->keep, name, texts->project);
	snprintf(name, sizeof(name), "seed-%llu.script", seed);
	write_text(duel->keep, name, texts->script);
}

static void fight(struct duel *duel, unsigned long long seed)
{
	struct random_texts texts;
	struct loaded loaded;
	char path[100];
	int before = duel->differ;

	if (!random_project(seed, seed % 4 == 0, &texts))
		abort();
	snprintf(path, sizeof(path), "%s/x.clprj", duel->folder);
	if (write_text(duel->folder, "x.clprj", texts.project) &&
	    write_text(duel->folder, "x.script", texts.script) &&
	    load_project(&loaded, path)) {
		compare(duel, seed, &loaded, false, texts.script);
		compare(duel, seed, &loaded, true, texts.script);
		unload_project(&loaded);
	} else {
		duel->differ++;
	}
	if (duel->differ > before && duel->keep)
		keep(duel, seed, &texts);
	free(texts.project);
	free(texts.script);
}

int main(int argc, char **argv)
{
	struct duel duel = { .ladder = getenv("LADDER") };
	const char *end = strstr(argv[0], "tests/bin/"); /* it is beside          */
	unsigned long long seed = 1, count = COUNT;
	char ladder[200], path[100];

	for (int i = 1; i + 1 < argc; i += 2) {
		if (strcmp(argv[i], "--count") == 0)
			count = strtoull(argv[i + 1], NULL, 10);
		else if (strcmp(argv[i], "--seed") == 0)
			seed = strtoull(argv[i + 1], NULL, 10);
		else if (strcmp(argv[i], "--keep") == 0)
			duel.keep = argv[i + 1];
	}
	snprintf(ladder, sizeof(ladder), "%.*sladder", end ? (int)(end - argv[0]) : 0,
		 end ? argv[0] : "");
	if (!duel.ladder)
		duel.ladder = ladder;
	snprintf(duel.folder, sizeof(duel.folder), "/tmp/classicXXXXXX");
	if (!mkdtemp(duel.folder))
		return 1;
	for (unsigned long long i = 0; i < count; i += BATCH) {
		char what[80];
		int before = duel.differ;

		for (unsigned long long k = i; k < i + BATCH && k < count; k++)
			fight(&duel, seed + k);
		snprintf(what, sizeof(what), "random projects from seed %llu", seed + i);
		CHECK_AS(duel.differ == before, what);
	}
	printf("# %d of %llu traces differ\n", duel.differ, 2 * count);
	snprintf(path, sizeof(path), "%s/x.clprj", duel.folder);
	unlink(path);
	snprintf(path, sizeof(path), "%s/x.script", duel.folder);
	unlink(path);
	snprintf(path, sizeof(path), "%s/x.err", duel.folder);
	unlink(path);
	rmdir(duel.folder);
	return tap_done();
}
