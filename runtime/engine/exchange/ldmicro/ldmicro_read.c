/* SPDX-License-Identifier: MIT
 *
 * ldmicro_read - the lines of an LDmicro file.
 *
 * A circuit is closed by END. A word that is not known is an element without a meaning here: only
 * its line is kept. What a line says is not looked at: ldmicro_text.c does.
 */
#include "engine/exchange/ldmicro/ldmicro.h"

#include "engine/base/ascii.h"
#include "engine/base/limits.h"

#include <stdlib.h>
#include <string.h>

static const struct { const char *text; int least; } words[] = {
#define WORD(id, least) { #id, least },
#define OTHER(id, text, least) { text, least },
	LDMICRO_WORDS(WORD, OTHER)
#undef WORD
#undef OTHER
};

struct reader {
	struct import *import;
	struct ldmicro_program *program;
	const char *at, *end;
	int number;              /* of the line in work, 1-based                   */
	const char *line;        /* NUL-ended, without blanks around it            */
	bool failed;
};

bool ldmicro_is(const void *bytes, size_t len)
{
	static const char *const heads[] = { "LDmicro0.", "LDmicro\r\n", "LDmicro\n" }; /* later branches write no version */

	for (size_t i = 0; i < sizeof(heads) / sizeof(*heads); i++)
		if (len > 9 && !memcmp(bytes, heads[i], strlen(heads[i])))
			return true;
	return false;
}

static bool fail(struct reader *r, enum diag_id id, const char *what)
{
	const struct diag place = { .id = id, .file = r->import->path, .line = r->number };

	if (!r->failed)
		diag_add(r->import->diags, place, "%.60s", what);
	r->failed = true;
	return false;
}

/* The next line that is not empty; ; begins a remark. false: the file ends. */
static bool next_line(struct reader *r)
{
	while (r->at < r->end && !r->failed) {
		const char *end = memchr(r->at, '\n', (size_t)(r->end - r->at));
		const char *from = r->at, *to = end ? end : r->end;

		r->number++;
		r->at = end ? end + 1 : r->end;
		while (from < to && strchr(" \t\r", *from))
			from++;
		while (to > from && strchr(" \t\r", to[-1]))
			to--;
		if (from == to || *from == ';')
			continue;
		r->line = foreign_utf8(r->import->arena, from, (size_t)(to - from));
		return r->line || fail(r, DIAG_NO_MEMORY, "");
	}
	return false;
}

/* Words of the line behind the first. */
static bool split(struct reader *r, struct ldmicro_node *node)
{
	char *copy = arena_copy(r->import->arena, r->line, strlen(r->line));
	char **arg;

	while (copy && *copy) {
		const size_t len = strcspn(copy, " \t");
		const bool more = copy[len] != '\0';

		arg = arena_push(r->import->arena, &node->arg, &node->args, sizeof(*arg));
		if (!arg)
			return fail(r, DIAG_NO_MEMORY, "");
		*arg = copy;
		copy[len] = '\0';
		copy += len + more;
		copy += strspn(copy, " \t");
	}
	if (!node->args)
		return fail(r, DIAG_NO_MEMORY, "");
	return true;
}

static struct ldmicro_node *node_new(struct reader *r, enum ldmicro_word word)
{
	struct ldmicro_node *node = arena_alloc(r->import->arena, sizeof(*node));

	if (!node) {
		fail(r, DIAG_NO_MEMORY, "");
		return NULL;
	}
	node->word = word;
	node->line = r->number;
	node->text = r->line;
	return node;
}

static struct ldmicro_node *read_element(struct reader *r)
{
	struct ldmicro_node *node = node_new(r, LDM_UNKNOWN);

	if (!node || !split(r, node))
		return NULL;
	r->program->elements++;
	for (size_t i = 0; i < sizeof(words) / sizeof(*words); i++)
		if (!strcmp(words[i].text, node->arg[0]))
			node->word = (enum ldmicro_word)i;
	if (node->word != LDM_UNKNOWN && node->args - 1 < words[node->word].least) {
		fail(r, DIAG_LDMICRO_VALUES, node->arg[0]);
		return NULL;
	}
	node->arg++;
	node->args--;
	return node;
}

/* The lines of a rung up to its END. */
static bool read_rung(struct reader *r, struct ldmicro_rung *rung)
{
	struct ldmicro_node **open[LDMICRO_DEPTH] = { &rung->first }; /* where the next goes */
	int depth = 1;

	while (depth && next_line(r)) {
		struct ldmicro_node *node;

		if (!strcmp(r->line, "END")) {
			depth--;
			continue;
		}
		if (!strncmp(r->line, "RUNG", 4) && (!r->line[4] || r->line[4] == ' '))
			return fail(r, DIAG_LDMICRO_DAMAGED, "END");
		const bool series = !strcmp(r->line, "SERIES");

		if (series || !strcmp(r->line, "PARALLEL")) {
			if (depth == LDMICRO_DEPTH)
				return fail(r, DIAG_LDMICRO_DEEP, "");
			node = node_new(r, series ? LDM_SERIES : LDM_PARALLEL);
		} else {
			node = read_element(r);
		}
		if (!node)
			return false;
		*open[depth - 1] = node;
		open[depth - 1] = &node->next;
		if (node->word == LDM_SERIES || node->word == LDM_PARALLEL)
			open[depth++] = &node->first;
	}
	return depth == 0 || fail(r, DIAG_LDMICRO_DAMAGED, "END");
}

static bool read_program(struct reader *r)
{
	while (next_line(r)) {
		struct ldmicro_rung *rung;

		if (strncmp(r->line, "RUNG", 4) != 0 || (r->line[4] && r->line[4] != ' '))
			return fail(r, DIAG_LDMICRO_DAMAGED, "RUNG");
		if (r->program->rungs == LIMIT_RUNGS)
			return fail(r, DIAG_LDMICRO_DEEP, "");
		rung = arena_push(r->import->arena, &r->program->rung, &r->program->rungs,
				  sizeof(*rung));
		if (!rung)
			return fail(r, DIAG_NO_MEMORY, "");
		*rung = (struct ldmicro_rung){ r->number, NULL };
		if (!read_rung(r, rung))
			return false;
	}
	return !r->failed;
}

/* ---- the head ---- */

/* `Xname at 12 0 0`; `2 bytes name` in the list of variables. */
static bool read_list(struct reader *r, bool sizes)
{
	struct ldmicro_program *p = r->program;

	while (next_line(r)) {
		struct ldmicro_node node = { .args = 0 };
		struct ldmicro_io *io;
		struct ldmicro_size *size;

		if (!strcmp(r->line, "END"))
			return true;
		if (!split(r, &node))
			return false;
		if (node.args < 3 || strcmp(node.arg[1], sizes ? "bytes" : "at") != 0)
			return fail(r, DIAG_LDMICRO_VALUES, node.arg[0]);
		if (sizes) {
			size = arena_push(r->import->arena, &p->size, &p->sizes, sizeof(*size));
			if (!size)
				return fail(r, DIAG_NO_MEMORY, "");
			*size = (struct ldmicro_size){ node.arg[2], ldmicro_int(node.arg[0]), r->number };
			continue;
		}
		io = arena_push(r->import->arena, &p->io, &p->ios, sizeof(*io));
		if (!io)
			return fail(r, DIAG_NO_MEMORY, "");
		*io = (struct ldmicro_io){ node.arg[0], ldmicro_int(node.arg[2]), r->number };
	}
	return fail(r, DIAG_LDMICRO_DAMAGED, "END");
}

static bool read_setting(struct reader *r)
{
	struct ldmicro_program *p = r->program;
	struct ldmicro_io *setting;

	if (!strncmp(r->line, "CYCLE=", 6)) {
		const long long value = strtol(r->line + 6, NULL, 10);

		p->cycle_us = value > 0 && value <= 60000000 ? (int)value : 0;
		p->cycle_line = r->number;
		return true;
	}
	if (!strncmp(r->line, "MICRO=", 6)) {
		p->micro = r->line + 6;
		return true;
	}
	setting = arena_push(r->import->arena, &p->setting, &p->settings, sizeof(*setting));
	if (!setting)
		return fail(r, DIAG_NO_MEMORY, "");
	*setting = (struct ldmicro_io){ r->line, 0, r->number };
	return true;
}

static bool read_head(struct reader *r)
{
	while (next_line(r)) {
		bool good = true;

		if (!strcmp(r->line, "PROGRAM"))
			return read_program(r);
		if (!strncmp(r->line, "LDmicro", 7))
			r->program->old = !strcmp(r->line + 7, "0.1");
		else if (!strcmp(r->line, "IO LIST"))
			good = read_list(r, false);
		else if (!strcmp(r->line, "VAR LIST"))
			good = read_list(r, true);
		else if (!strcmp(r->line, "PULL-UP LIST"))
			while (next_line(r) && strcmp(r->line, "END") != 0)
				good = good && read_setting(r);
		else
			good = read_setting(r);
		if (!good)
			return false;
	}
	return fail(r, DIAG_LDMICRO_DAMAGED, "PROGRAM");
}

struct ldmicro_program *ldmicro_read(struct import *import)
{
	struct reader r = { .import = import, .at = import->bytes, .line = "",
			    .program = arena_alloc(import->arena, sizeof(*r.program)) };

	r.end = r.at + import->len;
	if (!r.program) {
		fail(&r, DIAG_NO_MEMORY, "");
		return NULL;
	}
	r.program->micro = "";
	if (import->len > LDMICRO_BYTES) {
		fail(&r, DIAG_LDMICRO_DEEP, "");
		return NULL;
	}
	if (memchr(r.at, 0, import->len)) {
		const char *zero = memchr(r.at, 0, import->len);

		for (const char *at = r.at; at < zero; at++)
			r.number += *at == '\n';
		r.number++;
		fail(&r, DIAG_LDMICRO_DAMAGED, "RUNG");
		return NULL;
	}
	return read_head(&r) ? r.program : NULL;
}

/* ---- numbers ---- */

static int digit_of(char c)
{
	const char upper = ascii_upper(c);

	return ascii_digit(c) ? c - '0' : upper >= 'A' && upper <= 'F' ? upper - 'A' + 10 : 99;
}

bool ldmicro_number(const char *text, long long *value)
{
	const bool minus = *text == '-';
	const char *at = text + (minus || *text == '+');
	long long number = 0;
	int base = 10;

	if (*at == '\'') {
		const bool one = at[1] && (at[2] == '\'' || !at[2]);

		*value = one ? (unsigned char)at[1] : 0;
		return true;
	}
	if (!ascii_digit(*at))
		return false;
	if (*at == '0' && at[1]) {
		const char mark = ascii_upper(at[1]);

		base = mark == 'X' ? 16 : mark == 'B' ? 2 : 8;
		at += mark == 'X' || mark == 'B' || mark == 'O' ? 2 : 1;
	}
	for (; digit_of(*at) < base; at++)
		if (number < 1LL << 40)
			number = number * base + digit_of(*at);
	*value = minus ? -number : number;
	return true;
}

int ldmicro_int(const char *text)
{
	long long value;

	if (!ldmicro_number(text, &value))
		return 0;
	return value < -0x7fffffff ? -0x7fffffff : value > 0x7fffffff ? 0x7fffffff : (int)value;
}
