/* SPDX-License-Identifier: MIT
 *
 * render_options - reading the command line of --render; see render_options.h.
 */
#include "editor-gtk/render/render_options.h"
#include "editor-gtk/kit/i18n.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

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
	return wrong(_("%s wants a number from %g to %g, not %.24s"), option, least, most,
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
		return wrong(_("-o wants a name that ends in .svg, .pdf or .png, "
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

/* What the options say together. */
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

bool render_options_parse(int argc, char **argv, struct render_options *out)
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
				return wrong(_("%s wants a value"), word);
			if (!take_value(word, argv[++i], out))
				return false;
		} else if (!take_flag(word, out)) {
			return wrong(_("there is no option %.24s"), word);
		}
	}
	return judge(out, files, compare);
}

void render_options_help(void)
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
