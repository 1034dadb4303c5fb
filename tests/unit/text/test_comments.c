/* SPDX-License-Identifier: MIT
 *
 * test_comments - a file that is read and written keeps every comment, in its order.
 *
 * A generator: into each sample and each golden case it puts numbered comments at the ends of
 * all lines, on lines of their own, and between all tokens. Whatever is read without an error
 * must be written with every comment, and the written text is read and written as itself.
 */
#include "engine/base/lex.h"
#include "engine/text/text.h"

#include "tests/tap.h"

#include <glob.h>
#include <stdlib.h>

enum where { LINE_ENDS, OWN_LINES, BETWEEN, PLACES };
static const char *const place_name[PLACES] = { "at ends of lines", "on their own lines",
						"between tokens" };

struct source {
	const char *file;
	const char *text;
	size_t len;
	size_t *at;  /* where comments go, of @count */
	int count;
	bool slash;  /* // to the end of the line */
	bool own;    /* each with a newline behind it */
};

static int places, refused;

static struct project *read_one(const char *file, const char *text, size_t len)
{
	static struct diag_list diags;
	struct project *project = project_new(file);

	diag_init(&diags);
	if (!project)
		abort();
	if (text_read(project, file, text, len, NULL, &diags))
		return project;
	project_free(project);
	return NULL;
}

static bool is_read(const char *file, const char *text, size_t len)
{
	struct project *project = read_one(file, text, len);

	project_free(project);
	return project != NULL;
}

/* The text with comments @from … @to - 1. Owns: the caller. */
static char *with_comments(const struct source *source, int from, int to, size_t *len)
{
	char *text = malloc(source->len + (size_t)(to - from) * 24 + 1), *out = text;
	size_t at = 0;

	if (!text)
		abort();
	for (int i = from; i < to; i++) {
		memcpy(out, source->text + at, source->at[i] - at);
		out += source->at[i] - at;
		at = source->at[i];
		out += snprintf(out, 24, source->slash ? " // q%05dq" : " (* q%05dq *) ", i);
		if (source->own)
			*out++ = '\n';
	}
	memcpy(out, source->text + at, source->len - at);
	out += source->len - at;
	*out = '\0';
	*len = (size_t)(out - text);
	return text;
}

/* The first number that is missing or not in its order; @to: none. */
static int missing(const char *text, int from)
{
	int next = from;

	for (const char *at = text; (at = strchr(at, 'q')); at++) {
		char *end = NULL;
		const long number = at[1] >= '0' && at[1] <= '9' ? strtol(at + 1, &end, 10) : 0;

		if (!end || *end != 'q')
			continue;
		if (number != next)
			return next;
		next++;
	}
	return next;
}

static bool is_fixed(const char *file, const char *text, size_t len)
{
	struct project *project = read_one(file, text, len);
	size_t again = 0;
	char *second = project ? text_write(project, &again) : NULL;
	const bool same = second && again == len && !memcmp(text, second, len);

	project_free(project);
	free(second);
	return same;
}

static void show(const char *what, const struct source *source, int number)
{
	size_t from = source->at[number], to = from;

	while (from > 0 && source->text[from - 1] != '\n')
		from--;
	while (to < source->len && source->text[to] != '\n')
		to++;
	printf("# %s: %s q%05dq at column %d of: %.*s\n", source->file, what, number,
	       (int)(source->at[number] - from + 1), (int)(to - from), source->text + from);
}

/* Reads with comments @from … @to - 1; halves them until the rest is read. */
static bool try_comments(const struct source *source, int from, int to)
{
	size_t len, out_len = 0;
	char *text = with_comments(source, from, to, &len), *out;
	struct project *project = read_one(source->file, text, len);
	bool good = true;

	free(text);
	if (!project && to - from > 1) {
		good = try_comments(source, from, (from + to) / 2);
		return try_comments(source, (from + to) / 2, to) && good;
	}
	if (!project) {
		refused++;
		return true;
	}
	out = text_write(project, &out_len);
	project_free(project);
	if (!out)
		abort();
	const int lost = missing(out, from);

	places += to - from;
	if (lost < to) {
		char name[24];

		snprintf(name, sizeof(name), "q%05dq", lost);
		show(strstr(out, name) ? "moved" : "lost", source, lost);
		good = false;
	} else if (!is_fixed(source->file, out, out_len)) {
		show("is written otherwise the second time, from", source, from);
		good = false;
	}
	free(out);
	return good;
}

/* Fills @source->at. */
static void find_places(struct source *source, enum where place)
{
	struct lex lex;
	bool first = true;
	size_t size = 0;

	source->count = 0;
	source->own = place == OWN_LINES;
	lex_init(&lex, source->text, source->len);
	lex.newlines = lex.comments = true;
	for (;;) {
		const enum token_kind kind = lex_next(&lex);
		const struct token *token = &lex.token;
		size_t at = (size_t)(token->text - source->text);
		const bool first_here = first;
		bool here = place == LINE_ENDS ? kind == TOKEN_NEWLINE :
			    place == OWN_LINES ? first : kind != TOKEN_NEWLINE;

		if (kind == TOKEN_END || kind == TOKEN_BAD)
			break;
		first = kind == TOKEN_NEWLINE;
		if (place == BETWEEN && first_here && lex_is(&lex, "|"))
			here = false; /* as on a line of its own: above the RUNG */
		if (!here)
			continue;
		if ((size_t)source->count >= size) {
			size = size * 2 + 64;
			source->at = realloc(source->at, size * sizeof(*source->at));
			if (!source->at)
				abort();
		}
		source->at[source->count++] = at;
	}
}

static void try_file(const char *file, const char *text, size_t len)
{
	for (int place = 0; place < PLACES; place++)
		for (int slash = 0; slash < 2 - (place == BETWEEN); slash++) {
			struct source source = { .file = file, .text = text, .len = len,
						 .slash = slash };

			find_places(&source, (enum where)place);
			CHECK_AS(try_comments(&source, 0, source.count), place_name[place]);
			free(source.at);
		}
}

static void try_path(const char *path)
{
	FILE *in = fopen(path, "rb");
	static char text[1 << 20];
	size_t len = in ? fread(text, 1, sizeof(text), in) : 0;

	if (in)
		fclose(in);
	if (len == sizeof(text))
		abort();
	if (is_read(path, text, len))
		try_file(path, text, len);
}

/* Blocks without a line, and what no sample has. */
static const char *const rare[] = {
	"RUNGBOARD 1\n",
	"RUNGBOARD 1\nPROJECT \"p\"\nAUTHOR \"a\"\nVAR\nEND_VAR\nVAR RETAIN\nEND_VAR\n"
	"TYPE\nEND_TYPE\nVAR_ACCESS\nEND_VAR\nUSES \"u\"\nINCLUDE \"i\"\n",
	"RUNGBOARD 1\nCONFIGURATION C\nEND_CONFIGURATION\n",
	"RUNGBOARD 1\nCONFIGURATION C\nVAR_ACCESS\nEND_VAR\nVAR_GLOBAL\nEND_VAR\nEND_CONFIGURATION\n",
	"RUNGBOARD 1\nCONFIGURATION C\nVAR_ACCESS\nEND_VAR\nEND_CONFIGURATION\n",
	"RUNGBOARD 1\nCONFIGURATION C\nRESOURCE R ON PC\nEND_RESOURCE\nEND_CONFIGURATION\n",
	"RUNGBOARD 1\nCONFIGURATION C\nAREA V 8;\nRESOURCE R\nEND_RESOURCE\nVAR_ACCESS\nEND_VAR\n"
	"END_CONFIGURATION\n",
	"RUNGBOARD 1\nCONFIGURATION C\nRESOURCE R ON PC\nVAR_GLOBAL RETAIN\n  A,\n  B\n  : INT\n;\n"
	"END_VAR\nTASK T\n(\nINTERVAL\n:= T#1s, PRIORITY := 1\n)\n;\nPROGRAM P WITH T\n: M;\n"
	"END_RESOURCE\nVAR_ACCESS\n  X\n  : B\n  : INT READ_ONLY\n;\nEND_VAR\nAREA M 8;\n"
	"VAR_GLOBAL CONSTANT\n  K : INT := 1;\nEND_VAR\nEND_CONFIGURATION\n"
	"PROGRAM M LD\nVAR\nEND_VAR\nRUNG\nRUNG OFF\n| --- |\nEND_PROGRAM\n",
	"RUNGBOARD 1\nFUNCTION F : INT IL\nVAR_INPUT\n  A : INT;\nEND_VAR\nVAR_TEMP\nEND_VAR\n"
	"  MAX A, 2, 3\n  MUX A,3\n  AND( A\n  )\n  AND(\n  LD A\n  )\nHere:\n  ST F\n"
	"  CAL T(IN := TRUE, PT :=\n T#1s)\n  SEL(G := TRUE,\n IN0 := 1, IN1 := 2)\n  RET\n"
	"END_FUNCTION\nPROGRAM L IL\nEND_PROGRAM\nPROGRAM S SFC\nEND_PROGRAM\n",
};

int main(void)
{
	static const char *const where[] = { "ladders/*.rung", "tests/golden/*/main.rung" };

	for (size_t i = 0; i < sizeof(rare) / sizeof(*rare); i++)
		if (CHECK(is_read("rare", rare[i], strlen(rare[i]))))
			try_file("rare", rare[i], strlen(rare[i]));
	for (size_t i = 0; i < 2; i++) {
		glob_t found;

		if (!CHECK(glob(where[i], 0, NULL, &found) == 0))
			continue;
		for (size_t k = 0; k < found.gl_pathc; k++)
			try_path(found.gl_pathv[k]);
		globfree(&found);
	}
	CHECK_AS(places > 100000 && refused < places / 100, "most places take a comment");
	return tap_done();
}
