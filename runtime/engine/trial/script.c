/* SPDX-License-Identifier: MIT
 *
 * script - stimulus scripts. The same code reads each twice: first to find errors, then
 * to run it.
 */
#include "engine/trial/script.h"
#include "engine/trial/pace.h"
#include "engine/trial/twin.h"
#include "engine/trial/value.h"

#include "engine/base/lex.h"

#include <string.h>

#define REPEAT_MAX 1000000000

struct script {
	const char *file;
	const char *at, *end; /* of the line                                 */
	const char *line_start;
	int line;
	int64_t now_ns, period_ns;
	uint64_t scan;
	struct resource *resource;
	struct plant *plant;  /* NULL: none                                  */
	struct trace *trace;
	struct diag_list *diags;
	bool dry;             /* find errors only                            */
	bool scanned;         /* a line above has a scan                     */
};

/* The scans that a line asks for. */
struct stroke {
	int64_t step_ns;      /* -1: a period                                */
	int64_t repeat;
	bool quiet;
};

struct script_word {
	const char *text;
	size_t len;
};

static bool next_word(struct script *script, struct script_word *word)
{
	const char *at = script->at;

	while (at < script->end && (*at == ' ' || *at == '\t'))
		at++;
	word->text = at;
	if (at == script->end || *at == '#')
		return false;
	for (bool quoted = false; at < script->end; at++) {
		if (!quoted && (*at == ' ' || *at == '\t'))
			break;
		if (quoted && *at == '$' && script->end - at > 1)
			at++; /* $' is an escape, not the end */
		else if (*at == '\'')
			quoted = !quoted;
	}
	word->len = (size_t)(at - word->text);
	script->at = at;
	return true;
}

static struct diag place_of(const struct script *script, const char *at)
{
	return (struct diag){ .file = script->file, .line = script->line,
			      .column = (int)(at - script->line_start) + 1 };
}

static bool complain(struct script *script, enum diag_id id,
		     struct script_word word)
{
	struct diag place = place_of(script, word.text);

	place.id = id;
	return diag_add(script->diags, place, "%.*s",
			(int)(word.len < 60 ? word.len : 60), word.text);
}

static bool expect(struct script *script, struct script_word word, const char *what)
{
	struct diag place = place_of(script, word.text);

	place.id = DIAG_EXPECTED;
	return diag_add(script->diags, place, "%s", what);
}

static bool is_word(struct script_word word, const char *want)
{
	size_t i = 0;

	for (; i < word.len && want[i]; i++) {
		char c = word.text[i];

		if (c >= 'A' && c <= 'Z')
			c = (char)(c + 32);
		if (c != want[i])
			return false;
	}
	return i == word.len && !want[i];
}

static bool take_time(struct script *script, struct script_word word,
		      size_t skip, int64_t *ns)
{
	enum literal_result result = value_parse_time(
		word.text + skip, word.len - skip, VALUE_MS, ns);

	if (result == LITERAL_OK)
		return true;
	return complain(script, result == LITERAL_RANGE ? DIAG_LITERAL_RANGE :
							  DIAG_BAD_LITERAL,
			word);
}

static bool take_repeat(struct script *script, struct script_word word,
			int64_t *count)
{
	int64_t n = 0;

	for (size_t i = 1; i < word.len; i++) {
		if (word.text[i] < '0' || word.text[i] > '9')
			return complain(script, DIAG_BAD_LITERAL, word);
		n = n * 10 + (word.text[i] - '0');
		if (n > REPEAT_MAX)
			return complain(script, DIAG_LITERAL_RANGE, word);
	}
	if (!n)
		return complain(script, DIAG_LITERAL_RANGE, word);
	*count = n;
	return true;
}

static bool take_setting(struct script *script, struct script_word word)
{
	struct image *plant = script->plant ? &script->plant->resource.image : NULL;
	struct image *image = &script->resource->image;
	const char *equals = memchr(word.text, '=', word.len), *name = word.text;
	size_t len = (size_t)(equals - word.text);
	struct setting setting;

	if (value_side(image, plant, &name, &len) == plant && plant) {
		image = plant;
		word.len -= (size_t)(name - word.text);
		word.text = name;
	}
	if (!setting_parse(image, script->trace->project, word.text, word.len, &setting, script->diags,
			   place_of(script, word.text)))
		return false;
	if (!script->dry)
		image_set(image, setting.at, setting.value);
	return true;
}

static bool take_word(struct script *script, struct script_word word,
		      struct stroke *stroke)
{
	if (memchr(word.text, '=', word.len))
		return take_setting(script, word);
	if (is_word(word, "."))
		return true;
	if (is_word(word, "quiet")) {
		stroke->quiet = true;
		return true;
	}
	if (word.text[0] == '+')
		return take_time(script, word, 1, &stroke->step_ns);
	if ((word.text[0] == 'x' || word.text[0] == 'X') && word.len > 1 &&
	    word.text[1] >= '0' && word.text[1] <= '9')
		return take_repeat(script, word, &stroke->repeat);
	return complain(script, DIAG_SYNTAX, word);
}

bool script_fault(const struct resource *resource, const char *file, int line,
		  struct diag_list *diags)
{
	struct diag place = {
		.id = DIAG_FAULT, .file = file, .line = line,
		.pou = resource->fault_at.pou,
		.rung = (int)resource->fault_at.rung,
		.row = (int)resource->fault_at.row,
		.col = (int)resource->fault_at.col,
	};

	char text[96];

	if (place.pou && !*place.pou)
		place.pou = NULL;
	resource_fault_print(resource, text, sizeof(text));
	/* A list has POU and line in the text already. */
	return place.pou && place.rung ?
	       diag_add(diags, place, "%s" DIAG_AND "%.40s", text, place.pou) :
	       diag_add(diags, place, "%s", text);
}

/* False: the plant is in FAULT, or the program is not in RUN. */
static bool scan(struct script *script)
{
	struct plant *plant = script->plant;

	if (plant) {
		plant->resource.period_ns = script->resource->period_ns;
		plant_scan(plant, &script->resource->image, script->now_ns);
	}
	return pace_scan(script->resource, script->now_ns, script->resource->period_ns) &&
	       (!plant || plant->resource.state != STATE_FAULT);
}

static bool tell_fault(const struct script *script)
{
	const struct resource *resource = script->resource;

	if (resource->state != STATE_FAULT)
		resource = &script->plant->resource;
	return script_fault(resource, script->file, script->line, script->diags);
}

static void start(struct script *script)
{
	resource_start(script->resource);
	if (script->plant)
		resource_start(&script->plant->resource);
}

/* A plant goes on in a warm start: only the controller lost power. */
static bool restart(struct script *script, bool warm)
{
	return (warm || !script->plant ||
		twin_restart(&script->plant->resource, false)) &&
	       twin_restart(script->resource, warm);
}

static void tell_halt(const struct script *script)
{
	char text[96];

	resource_halt_print(script->resource, text, sizeof(text));
	trace_note(script->trace, text, strlen(text));
}

/* Runs the scans of one line. */
static bool run_stroke(struct script *script, const struct stroke *stroke,
		       struct script_word first)
{
	int64_t step = stroke->step_ns < 0 ? script->period_ns :
					     stroke->step_ns;

	for (int64_t i = 1; i <= stroke->repeat; i++) {
		if (script->now_ns > VALUE_TIME_MAX)
			return complain(script, DIAG_LITERAL_RANGE, first);
		script->now_ns += step;
		if (script->resource->halted)
			continue; /* until @reset */
		script->scan++;
		script->resource->period_ns = step;
		bool good = scan(script);

		if (!stroke->quiet || i == stroke->repeat || !good)
			trace_scan(script->trace, script->scan, script->now_ns);
		if (trace_stopped(script->trace))
			return false;
		if (script->resource->halted)
			tell_halt(script);
		else if (!good)
			return tell_fault(script);
	}
	return true;
}

static bool scan_line(struct script *script)
{
	struct stroke stroke = { -1, 1, false };
	struct script_word word, first = { script->at, 0 };
	bool good = true, any = false;

	while (next_word(script, &word)) {
		if (!any)
			first = word;
		any = true;
		good = take_word(script, word, &stroke) && good;
	}
	if (!any || !good)
		return good;
	script->scanned = true;
	return script->dry || run_stroke(script, &stroke, first);
}

static bool set_columns(struct script *script, struct script_word head)
{
	struct script_word word;
	bool any = false, good = true;

	if (script->scanned && script->trace->form != TRACE_LINES)
		return complain(script, DIAG_MISPLACED, head);
	trace_clear(script->trace);
	while (next_word(script, &word)) {
		any = true;
		good = trace_show(script->trace, word.text, word.len,
				  script->diags,
				  place_of(script, word.text)) && good;
	}
	if (!any && !trace_show_all(script->trace))
		return complain(script, DIAG_NO_MEMORY, head);
	return good;
}

static bool set_period(struct script *script, struct script_word head)
{
	struct script_word word;
	int64_t ns;

	if (!next_word(script, &word))
		return expect(script, head, "a time after @period");
	if (!take_time(script, word, 0, &ns))
		return false;
	if (!ns)
		return complain(script, DIAG_LITERAL_RANGE, word);
	script->period_ns = ns;
	return true;
}

/* 0: scans take no time. */
static bool set_speed(struct script *script, struct script_word head)
{
	struct script_word word;
	uint64_t speed;

	if (!next_word(script, &word))
		return expect(script, head, "words a millisecond after @speed");
	speed = pace_read(word.text, word.len);
	if (speed == PACE_NO_NUMBER)
		return complain(script, DIAG_BAD_LITERAL, word);
	if (speed > PACE_SPEED_MOST)
		return complain(script, DIAG_LITERAL_RANGE, word);
	if (!script->dry)
		pace_set(script->resource, speed);
	return true;
}

static void echo(struct script *script)
{
	while (script->at < script->end && *script->at == ' ')
		script->at++;
	if (!script->dry)
		trace_note(script->trace, script->at,
			   (size_t)(script->end - script->at));
	script->at = script->end;
}

/* With a frame of its own: that of read_lines() would be larger than 1 KB. */
__attribute__((noinline))
static bool directive(struct script *script)
{
	struct script_word head, rest;
	bool good = true;

	next_word(script, &head);
	if (is_word(head, "@print"))
		return set_columns(script, head);
	if (is_word(head, "@echo")) {
		echo(script);
		return true;
	}
	if (is_word(head, "@period"))
		good = set_period(script, head);
	else if (is_word(head, "@speed"))
		good = set_speed(script, head);
	else if (is_word(head, "@warm") || is_word(head, "@reset"))
		good = script->dry || restart(script, is_word(head, "@warm")) ||
		       complain(script, DIAG_NO_MEMORY, head);
	else
		return complain(script, DIAG_UNKNOWN_WORD, head);
	if (good && next_word(script, &rest))
		return complain(script, DIAG_SYNTAX, rest);
	return good;
}

/* After an error a dry run goes on, a real run stops. */
static bool read_lines(struct script *script, const char *text, size_t len)
{
	const char *at = text, *end = text + len;
	bool good = true;

	script->line = 0;
	script->now_ns = 0;
	script->scan = 0;
	script->scanned = false;
	while (at < end && (good || script->dry)) {
		const char *newline = memchr(at, '\n', (size_t)(end - at));
		const char *stop = newline ? newline : end;

		script->line++;
		script->line_start = script->at = at;
		script->end = stop > at && stop[-1] == '\r' ? stop - 1 : stop;
		while (script->at < script->end &&
		       (*script->at == ' ' || *script->at == '\t'))
			script->at++;
		bool command = script->at < script->end && *script->at == '@';

		if (!(command ? directive(script) : scan_line(script)))
			good = false;
		at = newline ? newline + 1 : end;
	}
	return good;
}

/* A trace must not send control characters to a terminal. */
static bool check_bytes(struct script *script, const char *text, size_t len)
{
	size_t bad = 0;
	bool valid = utf8_valid(text, len, &bad);
	size_t at = 0;

	script->line = 1;
	script->line_start = text;
	if (utf16_text(text, len))
		return complain(script, DIAG_UTF16, (struct script_word){ text, 0 });
	for (; at < (valid ? len : bad); at++) {
		unsigned char c = (unsigned char)text[at];

		if (c == '\n') {
			script->line++;
			script->line_start = text + at + 1;
		} else if ((c < 32 && c != '\t' && c != '\r') || c == 127) {
			return complain(script, DIAG_BAD_BYTE,
					(struct script_word){ text + at, 0 });
		}
	}
	return valid || complain(script, DIAG_BAD_UTF8,
				 (struct script_word){ text + at, 0 });
}

bool script_run(const char *file, const char *text, size_t len,
		int64_t period_ns, struct resource *resource, struct plant *plant,
		struct trace *trace, struct diag_list *diags)
{
	struct script script = { .file = file, .resource = resource, .plant = plant,
				 .trace = trace, .diags = diags, .dry = true };

	if (len >= 3 && !memcmp(text, "\xef\xbb\xbf", 3)) {
		text += 3;
		len -= 3;
	}
	if (!check_bytes(&script, text, len))
		return false;
	start(&script);
	trace->plant = plant ? &plant->resource.image : NULL;
	script.period_ns = period_ns;
	if (!read_lines(&script, text, len))
		return false;
	trace_clear(trace);
	if (!trace_show_all(trace))
		return complain(&script, DIAG_NO_MEMORY,
				(struct script_word){ text, 0 });
	script.dry = false;
	script.period_ns = period_ns;
	bool good = read_lines(&script, text, len);

	trace_end(trace);
	return good && !trace_stopped(trace);
}
