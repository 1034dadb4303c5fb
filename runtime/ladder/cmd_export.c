/* SPDX-License-Identifier: MIT
 *
 * cmd_export - `ladder export`: writes a program with its charts as ladders, or as a
 * project of ClassicLadder with the pins of the I/O map.
 *
 * Lines of ioconf.csv hold pins of a Raspberry Pi by their GPIO numbers. All inputs there
 * have a pull-up and the same sampling time; other settings of a map are reported.
 */
#include "ladder/paths.h"
#include "ladder/report.h"

#include "engine/exchange/classic/to_classic.h"
#include "engine/exchange/report.h"
#include "hal/iomap.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static enum status write_out(struct call *call, const char *text, size_t len)
{
	const char *path = call_option(call, "-o");

	if (path)
		return report_save(path, text, len);
	sink_write(&call->out, text, len);
	return STATUS_GOOD;
}

/* The program with each chart as ladders; NULL after messages. Owns: the caller, free(). */
static char *as_ladder(struct ladder *ladder, const char *path, size_t *len)
{
	struct diag_list *diags = report_list(path);
	char *text;

	if (!diags)
		return NULL;
	text = ladder_export_ladder(ladder, len, diags);
	ladder_import_places(ladder, diags);
	report_end(diags);
	return text;
}

/* ---- other languages ---- */

static bool becomes_st(const struct pou *pou)
{
	return (pou->language == LANGUAGE_LD || pou->language == LANGUAGE_FBD || pou->language == LANGUAGE_SFC) &&
	       !pou->included;
}

static bool becomes_fbd(const struct pou *pou)
{
	return (pou->language == LANGUAGE_LD || pou->language == LANGUAGE_SFC) && !pou->included;
}

static bool becomes_ladder(const struct pou *pou)
{
	return (pou->language == LANGUAGE_FBD || pou->language == LANGUAGE_SFC) && !pou->included;
}

static bool is_no_list(const struct pou *pou)
{
	return pou->language != LANGUAGE_IL && !pou->included;
}

/* A function main runs by itself where it is Structured Text (model/caller.h), so it stays. */
static void keep_main(const struct project *project, uint8_t *wanted)
{
	const int at = project_find_pou(project, "main", 4);

	if (at >= 0 && project->pou[at].kind == POU_FUNCTION && project->pou[at].unsaid)
		wanted[at] = 0;
}

/* The first error of the converted text, if it has one. */
static const struct diag *first_error(const struct diag_list *diags)
{
	for (int i = 0; i < diags->count; i++)
		if (diag_severity(diags->diag[i].id) == SEVERITY_ERROR)
			return &diags->diag[i];
	return NULL;
}

/* Writes @text in canonical form, if it is a program: a name may have another meaning in the other language. */
static enum status write_converted(struct call *call, const char *path, const char *text, size_t len,
				   enum pou_language to)
{
	struct ladder *ladder = ladder_new();
	enum status status = STATUS_NO;
	const struct diag *error;
	char *out;

	if (!ladder)
		return report_no_memory(path);
	if (ladder_load_text(ladder, path, text, len) && ladder_build(ladder)) {
		out = ladder_write(ladder, &len);
		status = out ? write_out(call, out, len) : report_no_memory(path);
		free(out);
	}
	error = first_error(ladder_diags(ladder));
	if (error)
		report_diag((struct diag){ .id = DIAG_CONVERT_UNREAD, .file = path },
			    "%s" DIAG_AND "%s" DIAG_AND "%s" DIAG_AND "%.*s", error->pou ? error->pou : path,
			    pou_language_word(to), diag_code(error->id), diag_name_length(error), error->arg);
	ladder_free(ladder);
	return status;
}

static void refuse_pou(const struct pou *pou, const struct project *project, enum pou_language to)
{
	struct diag place = { .id = DIAG_CONVERT_LANGUAGE, .file = pou->file, .line = pou->line };

	if (pou->included) {
		place.id = DIAG_CONVERT_INCLUDED;
		report_diag(place, "%s" DIAG_AND "%s", project_text(project, pou->name), pou->file);
		return;
	}
	report_diag(place, "%s" DIAG_AND "%s" DIAG_AND "%s", project_text(project, pou->name),
		    pou_language_word(pou->language), pou_language_word(to));
}

/* A byte a POU: those that are named behind FILE, else all that @fits. NULL after a message. */
static uint8_t *choose(const struct call *call, const struct project *project, enum pou_language to,
		       bool (*fits)(const struct pou *pou))
{
	uint8_t *wanted = calloc((size_t)project->pou_count + 1, 1);

	if (!wanted) {
		report_no_memory(call->arg[0]);
		return NULL;
	}
	for (int i = 0; call->arg_count == 1 && i < project->pou_count; i++)
		wanted[i] = fits(&project->pou[i]);
	for (int i = 1; i < call->arg_count; i++) {
		const int at = project_find_pou(project, call->arg[i], strlen(call->arg[i]));

		if (at >= 0 && fits(&project->pou[at])) {
			wanted[at] = 1;
			continue;
		}
		if (at < 0)
			report_missing(call, "POU", call->arg[i]);
		else
			refuse_pou(&project->pou[at], project, to);
		free(wanted);
		return NULL;
	}
	return wanted;
}

static enum status export_to(struct call *call, struct ladder *ladder, const char *path, enum pou_language to,
			     bool (*fits)(const struct pou *pou))
{
	uint8_t *wanted = choose(call, ladder_project(ladder), to, fits);
	struct diag_list *diags = wanted ? report_list(path) : NULL;
	enum status status = STATUS_NO;
	char *text = NULL;
	size_t len;

	if (wanted && to == LANGUAGE_IL)
		keep_main(ladder_project(ladder), wanted);
	if (diags) {
		text = ladder_export_as(ladder, wanted, to, &len, diags);
		ladder_import_places(ladder, diags);
		report_end(diags);
	}
	if (text)
		status = write_converted(call, path, text, len, to);
	free(text);
	free(wanted);
	return status;
}

static enum status export_st(struct call *call, struct ladder *ladder, const char *path)
{
	return export_to(call, ladder, path, LANGUAGE_ST, becomes_st);
}

static enum status export_ladder(struct call *call, struct ladder *ladder, const char *path)
{
	return export_to(call, ladder, path, LANGUAGE_LD, becomes_ladder);
}

static enum status export_fbd(struct call *call, struct ladder *ladder, const char *path)
{
	return export_to(call, ladder, path, LANGUAGE_FBD, becomes_fbd);
}

static enum status export_il(struct call *call, struct ladder *ladder, const char *path)
{
	return export_to(call, ladder, path, LANGUAGE_IL, is_no_list);
}

/* ---- the I/O map as lines of ioconf.csv ---- */

enum { RASPBERRY = 2, SAMPLES = 3, PINS = 1000 };

struct map_lines {
	const struct iomap *map;
	struct arena *arena;
	struct classic_lines *lines;
	struct classic_io *io; /* of @lines; it grows                          */
};

static __attribute__((format(printf, 3, 4)))
void tell(const struct map_lines *m, const struct io_point *point, const char *text, ...)
{
	char address[24];
	va_list args;

	iec_addr_print(point->addr, address, sizeof(address));
	fprintf(stderr, "%s:%d: changed: %s: ", m->map->file, point->text_line, address);
	va_start(args, text);
	vfprintf(stderr, text, args);
	va_end(args);
	fprintf(stderr, "\n");
}

/* 17 of GPIO17, or of line 17 of the chip with these pins; -1: no pin of a Raspberry Pi. */
static int pin_of(const struct io_point *point)
{
	char *end;
	long pin = -1;

	if (point->line && !strncmp(point->line, "GPIO", 4)) {
		pin = strtol(point->line + 4, &end, 10);
		if (end == point->line + 4 || *end)
			return -1;
	} else if (point->chip && !strncmp(point->chip, "pinctrl-bcm", 11)) {
		pin = (long)point->offset;
	}
	return pin >= 0 && pin < PINS ? (int)pin : -1;
}

/* ClassicLadder has one sampling time for all inputs: that of the first one here. */
static void note_debounce(struct map_lines *m, const struct io_point *point)
{
	int ms = (int)((point->debounce_ns + 999999) / 1000000);
	int sample = (ms + SAMPLES - 1) / SAMPLES;

	if (!m->lines->sample_ms && sample)
		m->lines->sample_ms = sample;
	if (ms != SAMPLES * (m->lines->sample_ms ? m->lines->sample_ms : 10))
		tell(m, point, "must be steady for %d ms in ClassicLadder, as all inputs",
		     SAMPLES * (m->lines->sample_ms ? m->lines->sample_ms : 10));
}

static void tell_settings(struct map_lines *m, const struct io_point *point)
{
	if (!point->output && point->bias != BIAS_UP)
		tell(m, point, "has a pull-up in ClassicLadder");
	if (point->output && point->bias != BIAS_AS_IS)
		tell(m, point, "an output has no pull in ClassicLadder");
	if (point->output && point->drive != DRIVE_AS_IS && point->drive != DRIVE_PUSH_PULL)
		tell(m, point, "is driven to both levels in ClassicLadder");
	if (point->safe || point->hold)
		tell(m, point, "has no safe value in ClassicLadder: it stays as it is");
}

static bool goes_on(const struct classic_io *last, const struct io_point *point, int bit,
		    int pin)
{
	return last && last->output == point->output && last->inverted == point->active_low &&
	       last->first + last->count == bit && last->channel + last->count == pin;
}

static void add_point(struct map_lines *m, const struct io_point *point)
{
	const int bit = (int)point->addr.byte * 8 + point->addr.bit, pin = pin_of(point);
	struct classic_lines *lines = m->lines;
	struct classic_io *last = lines->count ? &m->io[lines->count - 1] : NULL;

	if (point->driver != DRIVER_gpio || pin < 0) {
		tell(m, point, "is no pin of a Raspberry Pi (line=GPIO17) and is not exported");
		return;
	}
	tell_settings(m, point);
	if (!point->output)
		note_debounce(m, point);
	if (goes_on(last, point, bit, pin)) {
		last->count++;
		return;
	}
	last = arena_push(m->arena, &m->io, &lines->count, sizeof(*last));
	if (last)
		*last = (struct classic_io){ .output = point->output, .first = bit,
			.device = RASPBERRY, .channel = pin, .count = 1,
			.inverted = point->active_low };
}

/* Reads a map and adds its lines to @lines, in @arena. Fails: false after messages. */
static bool export_lines(const char *path, const char *text, size_t len, struct arena *arena,
		  struct classic_lines *lines)
{
	struct diag_list *diags = report_list(path);
	struct iomap map = { .file = path };
	struct map_lines m = { &map, arena, lines, NULL };
	bool good;

	*lines = (struct classic_lines){ 0 };
	if (!diags)
		return false;
	good = iomap_read(&map, arena, path, text, len, diags);
	report_end(diags);
	for (int i = 0; good && i < map.count; i++)
		add_point(&m, &map.point[i]);
	lines->io = m.io;
	return good && !arena->failed;
}

/* ---- ClassicLadder ---- */

struct target {
	enum classic_dialect dialect;
	struct classic_lines lines;
	struct arena arena; /* of the lines                                     */
};

/* Reads the I/O map: that of --io, or that of an imported project, or the file beside
 * FILE. */
static bool find_lines(struct call *call, struct ladder *ladder, struct target *to)
{
	const char *given = call_option(call, "--io"), *own = ladder_import_io(ladder);
	char *beside = path_with_ending(call->arg[0], ".io"), *text;
	const char *path = given ? given : beside;
	bool good = true;
	size_t len;

	if (own && !given) {
		good = export_lines(call->arg[0], own, strlen(own), &to->arena, &to->lines);
	} else if (given || (beside && access(beside, R_OK) == 0)) {
		text = report_read(path, &len);
		good = text && export_lines(path, text, len, &to->arena, &to->lines);
		free(text);
	}
	free(beside);
	return good;
}

static const struct { const char *word; enum classic_dialect dialect; } classic_words[] = {
	{ "classicladder", CLASSIC_UPSTREAM }, { "linuxcnc", CLASSIC_LINUXCNC },
	{ "numeric", CLASSIC_NUMERIC },
};
enum { CLASSIC_WORDS = sizeof(classic_words) / sizeof(*classic_words) };

/* Prints what has another meaning there or is left out; to standard error, because the result
 * may go to standard output. */
static void print_changes(const char *path, const struct classic_report *report)
{
	for (int i = 0; i < report->count; i++) {
		const struct report_line *line = &report->line[i];
		const char *kind = line->kind == REPORT_LOST ? "lost" : line->kind == REPORT_TAKEN ? "kept" : "changed";

		if (line->line)
			fprintf(stderr, "%s:%d: %s: %s\n", path, line->line, kind, line->text);
		else
			fprintf(stderr, "%s: %s: %s\n", path, kind, line->text);
	}
}

static enum status export_classic(struct call *call, struct ladder *ladder,
				  const char *path, const struct target *to)
{
	struct diag_list *diags = report_list(path);
	struct classic_report report;
	enum status status = STATUS_NO;
	size_t len;
	char *text;

	if (!diags)
		return STATUS_WRONG;
	report_init(&report);
	text = ladder_export_classic(ladder, to->dialect, &to->lines, &len, &report, diags);
	ladder_import_places(ladder, diags);
	report_end(diags);
	if (text) {
		print_changes(path, &report);
		status = write_out(call, text, len);
	}
	report_free(&report);
	free(text);
	return status;
}

/* Exports charts that do not fit a page of ClassicLadder as ladders. */
static enum status export_as_ladder(struct call *call, struct ladder *ladder,
				    const char *path, const struct target *to)
{
	struct ladder *again = ladder_new();
	enum status status = STATUS_NO;
	size_t len;
	char *text;

	if (!again)
		return report_no_memory(path);
	text = as_ladder(ladder, path, &len);
	if (text && ladder_load_text(again, path, text, len) && ladder_build(again))
		status = export_classic(call, again, path, to);
	else if (text)
		report_diags(ladder_diags(again));
	free(text);
	ladder_free(again);
	return status;
}

static enum status export_plcopen(struct call *call, struct ladder *ladder, const char *path)
{
	struct classic_report report;
	enum status status;
	size_t len = 0;
	char *text;

	report_init(&report);
	text = ladder_export_plcopen(ladder, &len, &report);
	status = text ? write_out(call, text, len) : report_no_memory(path);
	if (text)
		print_changes(path, &report);
	report_free(&report);
	free(text);
	return status;
}

static enum status export_to_classic(struct call *call, struct ladder *ladder, const char *path, int word)
{
	struct target to = { .lines = { NULL, 0, 0 } };
	enum status status;

	to.dialect = classic_words[word].dialect;
	arena_init(&to.arena);
	if (!find_lines(call, ladder, &to))
		status = STATUS_NO;
	else if (ladder_sfc_fits_classic(ladder))
		status = export_classic(call, ladder, path, &to);
	else
		status = export_as_ladder(call, ladder, path, &to);
	arena_free(&to.arena);
	return status;
}

static const struct {
	const char *word;
	enum status (*run)(struct call *call, struct ladder *ladder, const char *path);
} languages[] = { { "ld", export_ladder }, { "st", export_st }, { "fbd", export_fbd }, { "il", export_il },
	{ "plcopen", export_plcopen } };
enum { LANGUAGES = sizeof(languages) / sizeof(*languages) };

enum status cmd_export(struct call *call)
{
	const char *path = call->arg[0], *as = call_option(call, "--as");
	int classic = 0, language = 0;
	struct ladder *ladder;
	enum status status;

	while (as && classic < CLASSIC_WORDS && strcmp(as, classic_words[classic].word) != 0)
		classic++;
	while (as && language < LANGUAGES && strcmp(as, languages[language].word) != 0)
		language++;
	if (!as || (classic == CLASSIC_WORDS && language == LANGUAGES))
		return report_usage(call, "--as needs st, ld, fbd, il, plcopen, classicladder, linuxcnc or numeric");
	if (call->arg_count > 1 && (language == LANGUAGES || languages[language].run == export_plcopen))
		return report_usage(call, "POUs can be named with --as st, ld, fbd and il");
	ladder = program_new(false);
	if (!ladder)
		return report_no_memory(path);
	ladder_classic_task(ladder, true);
	status = report_load(ladder, path, true);
	if (status == STATUS_GOOD)
		status = language < LANGUAGES ? languages[language].run(call, ladder, path) :
			 export_to_classic(call, ladder, path, classic);
	ladder_free(ladder);
	return status;
}
