/* SPDX-License-Identifier: MIT
 *
 * render - `ladder-editor --render`: reads its options, loads a project, draws it, writes a
 * file. render_sheet and pages draw; render_diff compares.
 */
#include "editor-gtk/render/render.h"

#include "editor-gtk/document/disk.h"
#include "editor-gtk/draw/fbd_layout.h"
#include "editor-gtk/draw/pages.h"
#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/render/render_diff.h"
#include "editor-gtk/render/render_sheet.h"

#include "engine/ladder.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#define MOST_PIXELS 32000 /* px of a side of a PNG; cairo's limit is 32767      */

/* ---- the command line ---- */

__attribute__((format(printf, 1, 2)))
static bool wrong(const char *format, ...)
{
	va_list args;

	fprintf(stderr, "ladder-editor: ");
	va_start(args, format);
	vfprintf(stderr, format, args);
	va_end(args);
	fprintf(stderr, "; %s\n", _("see ladder-editor --render --help"));
	return false;
}

static bool number(const char *option, const char *text, double least, double most,
		   double *out)
{
	char *end;

	*out = g_ascii_strtod(text, &end);
	if (end != text && !*end && *out >= least && *out <= most)
		return true;
	return wrong(_("%s needs a number from %g to %g, not %.24s"), option, least, most,
		     text);
}

static bool format_of(const char *name, enum render_format *format)
{
	const char *dot = strrchr(name, '.');

	if (dot && g_ascii_strcasecmp(dot, ".svg") == 0)
		*format = RENDER_SVG;
	else if (dot && g_ascii_strcasecmp(dot, ".pdf") == 0)
		*format = RENDER_PDF;
	else if (dot && g_ascii_strcasecmp(dot, ".png") == 0)
		*format = RENDER_PNG;
	else
		return wrong(_("-o needs a name that ends in .svg, .pdf or .png, "
			       "not %.80s"), name);
	return true;
}

static bool show_of(const char *name, enum drafting_show *show)
{
	static const char *const known[] = { "both", "symbols", "addresses" };

	for (size_t i = 0; i < G_N_ELEMENTS(known); i++)
		if (strcmp(name, known[i]) == 0) {
			*show = i;
			return true;
		}
	return wrong(_("--show is both, symbols or addresses, not %.24s"), name);
}

/* Options without a value. */
static bool take_flag(const char *name, struct render_options *out)
{
	if (!strcmp(name, "--dark"))
		out->theme = out->theme == THEME_CONTRAST ? THEME_CONTRAST_DARK :
							    THEME_DARK;
	else if (!strcmp(name, "--contrast"))
		out->theme = out->theme == THEME_DARK ? THEME_CONTRAST_DARK :
							THEME_CONTRAST;
	else if (!strcmp(name, "--print"))
		out->theme = THEME_PRINT;
	else if (!strcmp(name, "--landscape"))
		out->paper.landscape = true;
	else if (!strcmp(name, "--check"))
		out->check = true;
	else if (!strcmp(name, "--original"))
		out->original = ORIGINAL_ALONE;
	else if (!strcmp(name, "--before-after"))
		out->original = ORIGINAL_BOTH;
	else if (!strcmp(name, "--help") || !strcmp(name, "-h"))
		out->help = true;
	else
		return false;
	return true;
}

static bool take_value(const char *name, const char *value, struct render_options *out)
{
	double parsed;

	if (!strcmp(name, "-o")) {
		out->out = value;
		return format_of(value, &out->format);
	}
	if (!strcmp(name, "--pou")) {
		out->pou = value;
		return true;
	}
	if (!strcmp(name, "--date")) {
		out->paper.date = value;
		return true;
	}
	if (!strcmp(name, "--show"))
		return show_of(value, &out->show);
	if (!strcmp(name, "--paper"))
		return paper_find(value, &out->paper) ||
		       wrong(_("--paper is a4, a3, a5, letter or legal, not %.24s"), value);
	if (!strcmp(name, "--rung")) {
		bool good = number(name, value, 1, LIMIT_RUNGS, &parsed);

		out->rung = good ? (int)parsed : 0;
		return good;
	}
	float *size = !strcmp(name, "--width") ? &out->width : &out->scale;
	bool good = number(name, value, size == &out->width ? 100 : 0.1,
			   size == &out->width ? 20000 : 10, &parsed);
	if (good)
		*size = (float)parsed;
	return good;
}

static bool wants_value(const char *name)
{
	static const char *const known[] = { "-o", "--pou", "--rung", "--width", "--scale",
					     "--paper", "--date", "--show" };

	for (size_t i = 0; i < G_N_ELEMENTS(known); i++)
		if (!strcmp(name, known[i]))
			return true;
	return false;
}

static bool take_file(const char *name, bool compare, int *files,
		      struct render_options *out)
{
	if (*files == (compare ? 2 : 1))
		return wrong(_("one file too many: %.80s"), name);
	if (compare && *files == 0)
		out->older = name;
	else
		out->file = name;
	++*files;
	return true;
}

static bool is_compared(int argc, char **argv)
{
	for (int i = 1; i < argc; i++)
		if (!strcmp(argv[i], "--diff"))
			return true;
	return false;
}

/* Refuses options that contradict each other. */
static bool judge(const struct render_options *out, int files, bool compare)
{
	if (out->help)
		return true;
	if (files < (compare ? 2 : 1))
		return wrong(_("a file is missing"));
	if (!out->out)
		return wrong(_("-o is missing"));
	if (out->rung && compare)
		return wrong(_("--rung does not go with --diff"));
	if (out->check && (compare || out->format == RENDER_PDF))
		return wrong(_("--check goes with one file and .svg or .png"));
	if (out->original && (compare || out->check || out->format == RENDER_PDF))
		return wrong(_("--original and --before-after go with one file and .svg or "
			       ".png"));
	if (compare && out->format == RENDER_PDF)
		return wrong(_("--diff draws .svg and .png, not %.80s"), out->out);
	return true;
}

/* @argv[0] is the program. Errors go to stderr. Fails: false. */
static bool parse(int argc, char **argv, struct render_options *out)
{
	bool compare = is_compared(argc, argv), only_files = false;
	int files = 0;

	*out = (struct render_options){ .scale = 1 };
	paper_find("a4", &out->paper);
	for (int i = 1; i < argc; i++) {
		const char *word = argv[i];

		if (only_files || word[0] != '-') {
			if (!take_file(word, compare, &files, out))
				return false;
		} else if (!strcmp(word, "--")) {
			only_files = true;
		} else if (!strcmp(word, "--render") || !strcmp(word, "--diff")) {
			continue;
		} else if (wants_value(word)) {
			if (i + 1 == argc)
				return wrong(_("%s needs a value"), word);
			if (!take_value(word, argv[++i], out))
				return false;
		} else if (!take_flag(word, out)) {
			return wrong(_("“%.24s” is not an option"), word);
		}
	}
	return judge(out, files, compare);
}

static void help(void)
{
	fputs(_("usage: ladder-editor --render FILE [OPTION]... -o PICTURE.svg|.pdf|.png\n"
		"       ladder-editor --render --diff OLD NEW [OPTION]... -o PICTURE.svg|.png\n"
		"\n"
		"Draws a project without a display. A PDF has pages with a title block, the\n"
		"symbols, and below each coil where it is read. --diff draws the rungs that\n"
		"differ: what was added, removed and changed.\n"
		"\n"
		"  -o PICTURE       what is written; its ending says the format\n"
		"  --pou NAME       only this program, function or block\n"
		"  --rung N         only this rung, from 1\n"
		"  --show WHAT      above elements: both (symbol and address), symbols, addresses\n"
		"  --check          marks what is wrong in the rungs, and says it\n"
		"  --original       of a project of ClassicLadder: the rungs as it has them\n"
		"  --before-after   the same, and below each what becomes of it here\n"
		"  --dark, --contrast, --print\n"
		"                   colours: dark, high contrast, black on white\n"
		"  --width PX       pixels from rail to rail at least\n"
		"  --scale S        0.1 to 10; 1 is 96 pixels an inch\n"
		"  --paper SIZE     of a PDF: a4, a3, a5, letter, legal\n"
		"  --landscape      of a PDF\n"
		"  --date TEXT      in the title block; without it there is none\n"
		"\n"
		"Exit status: 0; 1 if the file has errors; 2 if the command line is wrong, or a\n"
		"file cannot be read or written.\n"), stdout);
}

/* ---- drawing ---- */

static void say_diags(const struct diag_list *diags)
{
	for (int i = 0; i < diags->count; i++) {
		const struct diag *diag = &diags->diag[i];
		char *line = diag_said_line(diag);
		char *size = disk_told_size(diag->file, diag, LIMIT_TEXT);

		fprintf(stderr, "%s%s\n", line, size);
		g_free(line);
		g_free(size);
	}
	if (diags->dropped)
		fprintf(stderr, _("and %d more\n"), diags->dropped);
}

/* NULL: it has errors, or *status is RENDER_WRONG: it cannot be read. */
static struct ladder *load(const char *path, enum render_status *status)
{
	struct ladder *ladder = ladder_new();

	*status = RENDER_WRONG;
	if (!ladder || !ladder_take_classic(ladder, false)) {
		ladder_free(ladder);
		return NULL;
	}
	if (ladder_load(ladder, path) && ladder_project(ladder)) {
		*status = RENDER_GOOD;
		return ladder;
	}
	say_diags(ladder_diags(ladder));
	if (ladder_could_read(ladder))
		*status = RENDER_NO;
	if (!ladder_diags(ladder)->count)
		fprintf(stderr, _("ladder-editor: %s: a code image cannot be drawn\n"),
			path);
	ladder_free(ladder);
	return NULL;
}

static enum render_status failed(const char *path, const char *why)
{
	fprintf(stderr, _("ladder-editor: cannot write %s: %s\n"), path, why);
	return RENDER_WRONG;
}

/* Do the POU and the rung that the options name exist? */
static bool is_there(const struct project *project, const struct render_options *options,
		     int pou)
{
	const struct pou *first;

	if (options->pou && pou < 0) {
		fprintf(stderr, _("ladder-editor: %s has no POU called %.80s\n"),
			options->file, options->pou);
		return false;
	}
	if (!options->rung || options->original)
		return true;
	first = pou >= 0 ? &project->pou[pou] : project->pou_count ? project->pou : NULL;
	if (first && options->rung <= MAX(first->rung_count, fbd_layout_networks(first)))
		return true;
	fprintf(stderr, _("ladder-editor: %s has no rung %d\n"), options->file,
		options->rung);
	return false;
}

/* Writes all of it, or leaves the old file. @bytes: taken over; NULL: out of memory. */
static enum render_status write_out(GBytes *bytes, const char *path)
{
	enum render_status status = RENDER_GOOD;
	GError *error = NULL;

	if (!bytes)
		return failed(path, g_strerror(ENOMEM));
	if (!disk_save(path, g_bytes_get_data(bytes, NULL), g_bytes_get_size(bytes), &error)) {
		fprintf(stderr, "ladder-editor: %s\n", error->message);
		g_error_free(error);
		status = RENDER_WRONG;
	}
	g_bytes_unref(bytes);
	return status;
}

static enum render_status write_svg(const struct picture *picture,
				    const struct render_options *options,
				    const struct theme *theme)
{
	char *svg = picture_svg(picture, theme, options->scale, true);

	return write_out(g_bytes_new_take(svg, strlen(svg)), options->out);
}

static enum render_status write_png(const struct picture *picture,
				    const struct render_options *options,
				    const struct theme *theme, struct lettering *lettering)
{
	double scale = (double)options->scale;
	double width = (double)picture->width * scale;
	double height = (double)picture->height * scale;

	if (width > MOST_PIXELS || height > MOST_PIXELS)
		return failed(options->out, _("it would be too large; draw one POU or one "
					      "rung, or an .svg"));
	return write_out(picture_png(picture, theme, lettering, options->scale),
			 options->out);
}

static enum render_status write_picture(struct picture *picture,
					const struct render_options *options,
					struct lettering *lettering)
{
	const struct theme *theme = theme_get(options->theme, THEME_GREEN);

	if (options->format == RENDER_SVG)
		return write_svg(picture, options, theme);
	return write_png(picture, options, theme, lettering);
}

/* A PDF has no date and no name of a machine. */
static enum render_status write_pdf(const struct project *project, int pou,
				    const struct render_options *options,
				    struct lettering *lettering)
{
	struct pages *pages = pages_new(project, options->file, pou, options->rung,
					options->show, &options->paper, lettering);
	const char *title = project_text(project, project->title);
	GBytes *pdf = pages_pdf(pages, &options->paper, *title ? title : options->file,
				"2000-01-01T00:00:00Z");

	pages_free(pages);
	return write_out(pdf, options->out);
}

/* Draws rungs, or their originals. */
static bool draw_rungs(struct ladder *ladder, int pou, const struct render_options *options,
		       struct lettering *lettering, struct picture *picture)
{
	if (!options->original)
		render_sheets(ladder_project(ladder), pou, options, lettering, picture);
	else if (!render_classic(ladder, pou, options, lettering, picture))
		return false;
	return true;
}

static enum render_status draw(struct ladder *ladder, const struct render_options *options,
			       struct lettering *lettering)
{
	const struct project *project = ladder_project(ladder);
	int pou = options->pou ?
		project_find_pou(project, options->pou, strlen(options->pou)) : -1;
	enum render_status status;
	struct picture picture;

	if (!is_there(project, options, pou))
		return RENDER_WRONG;
	if (options->rung && pou < 0 && !options->original)
		pou = 0;
	if (options->format == RENDER_PDF)
		return write_pdf(project, pou, options, lettering);
	picture_init(&picture);
	if (draw_rungs(ladder, pou, options, lettering, &picture)) {
		status = write_picture(&picture, options, lettering);
	} else {
		fprintf(stderr, _("ladder-editor: %s: does not come from ClassicLadder\n"),
			options->file);
		status = RENDER_WRONG;
	}
	picture_clear(&picture);
	return status;
}

static enum render_status draw_difference(const struct project *project,
					  const struct render_options *options,
					  struct lettering *lettering)
{
	enum render_status status;
	struct ladder *older = load(options->older, &status);
	struct picture picture;

	if (!older)
		return status;
	picture_init(&picture);
	render_diff(ladder_project(older), project, options, lettering, &picture);
	status = write_picture(&picture, options, lettering);
	picture_clear(&picture);
	ladder_free(older);
	return status;
}

int render_main(int argc, char **argv)
{
	struct render_options options;
	enum render_status status;

	if (!parse(argc, argv, &options))
		return RENDER_WRONG;
	if (options.help) {
		help();
		return RENDER_GOOD;
	}
	struct ladder *ladder = load(options.file, &status);
	if (!ladder)
		return (int)status;
	if (options.check) {
		status = ladder_build(ladder) ? RENDER_GOOD : RENDER_NO;
		say_diags(ladder_diags(ladder));
		options.diags = ladder_diags(ladder);
	}
	PangoContext *context = lettering_context();
	struct lettering *lettering = lettering_new(context, NULL);
	enum render_status drawn = options.older ?
		draw_difference(ladder_project(ladder), &options, lettering) :
		draw(ladder, &options, lettering);
	lettering_free(lettering);
	g_object_unref(context);
	ladder_free(ladder);
	return (int)(drawn == RENDER_GOOD ? status : drawn);
}
