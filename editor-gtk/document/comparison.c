/* SPDX-License-Identifier: MIT
 *
 * comparison - the differences of two versions as rows; see comparison.h.
 */
#include "editor-gtk/document/comparison.h"

#include "editor-gtk/document/disk.h"
#include "editor-gtk/document/iomap_beside.h"
#include "editor-gtk/document/iomap_compare.h"
#include "editor-gtk/draw/diff_draw.h"
#include "editor-gtk/draw/diff_networks.h"
#include "editor-gtk/draw/place.h"
#include "editor-gtk/edit/fbd_lines.h"
#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"

#include "engine/base/limits.h"
#include "engine/base/name.h"
#include "engine/compare/compare.h"
#include "engine/text/pou_print.h"
#include "engine/xref/xref.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#define ARROW " \xe2\x86\x92 "

/* ---- words of the engine ---- */

/* Words of engine/compare/compare.c that are shown. Names of pins and of the file stay. */
static const char *const words[] = {
	N_("name"), N_("type"), N_("address"), N_("initial value"), N_("block"), N_("comment"),
	N_("label"), N_("title"), N_("kind"), N_("opening comment"), N_("closing comment"),
	N_("evolution"), N_("language"), N_("parameters"), N_("task"), N_("program"),
	N_("bytes"), N_("resource"), N_("kind of the resource"), N_("comment of the resource"),
	N_("comment in the resource"), N_("comment behind the resource"),
	N_("link"), N_("variable"), N_("function"), N_("function block"), N_("subroutine"),
	N_("project"), N_("configuration"), N_("area"), N_("instance"), N_("added"),
	N_("removed"), N_("changed"), N_("switched off"), N_("switched on"),
	N_("order, layout or comments"),
};

static const char *word(const char *text)
{
	for (gsize i = 0; text && i < G_N_ELEMENTS(words); i++)
		if (strcmp(text, words[i]) == 0)
			return _(text);
	return text;
}

const char *compare_change_text(enum compare_change change)
{
	static const char *const text[] = {
		[COMPARE_CHANGED] = N_("changed"), [COMPARE_ADDED] = N_("added"),
		[COMPARE_REMOVED] = N_("removed"), [COMPARE_MOVED] = N_("moved"),
	};

	return _(text[change]);
}

static bool is_change(const struct compare_difference *what, const char *change)
{
	return what->change && g_str_has_prefix(what->change, change);
}

/* ---- rows ---- */

/* A comparison while its rows are made. */
struct making {
	struct comparison *of;
	struct compare_difference last; /* of the last row; its POU is text of a project */
	char *subject;                  /* of that difference                   */
	struct place_sheet sheet;
	int chart;                      /* POU of the chart or the networks that have their rows; -1: none */
	bool differs;                   /* have they any row?                          */
};

static void clear_detail(gpointer data)
{
	struct compare_detail *detail = data;

	g_free(detail->label);
	g_free(detail->from);
	g_free(detail->to);
}

static void row_free(gpointer data)
{
	struct compare_row *row = data;

	g_free(row->group);
	g_free(row->title);
	g_free(row->words);
	g_array_unref(row->details);
	g_free(row);
}

static struct compare_row *row_new(struct making *making, char *group, char *title)
{
	struct compare_row *row = g_new0(struct compare_row, 1);

	*row = (struct compare_row){ .group = group, .title = title, .words = g_strdup(""),
		.details = g_array_new(FALSE, FALSE, sizeof(struct compare_detail)),
		.pou_a = -1, .pou_b = -1, .at_a = -1, .at_b = -1, .table = -1, .index = -1 };
	g_array_set_clear_func(row->details, clear_detail);
	g_ptr_array_add(making->of->rows, row);
	return row;
}

/* Takes @line. */
static void add_words(struct compare_row *row, char *line)
{
	char *all = *row->words ? g_strdup_printf("%s\n%s", row->words, line) : g_strdup(line);

	g_free(row->words);
	g_free(line);
	row->words = all;
}

static int pou_of(const struct project *project, const char *name)
{
	return name ? project_find_pou(project, name, strlen(name)) : -1;
}

/* ---- what a difference is about ---- */

static char *pou_group(struct making *making, const char *name)
{
	const struct project *a = ladder_project(making->of->of_a);
	const struct project *b = ladder_project(making->of->of_b);
	const int in_b = pou_of(b, name), in_a = pou_of(a, name);
	const struct project *project = in_b < 0 ? a : b;
	const int pou = in_b < 0 ? in_a : in_b;

	return pou < 0 ? g_strdup(name) :
	       g_strdup_printf("%s %s", pou_word(project->pou[pou].kind),
			       project_text(project, project->pou[pou].name));
}

static char *group_of(struct making *making, const struct compare_difference *what)
{
	switch (what->group) {
	case COMPARE_PROJECT: return g_strdup(_("Project"));
	case COMPARE_CONFIG: return g_strdup(_("Tasks and memory"));
	case COMPARE_TYPES: return g_strdup(_("Data types"));
	case COMPARE_GLOBALS: return g_strdup(_("Symbols"));
	case COMPARE_POU: break;
	}
	return pou_group(making, what->pou ? what->pou : what->subject);
}

/* With its label, else its title. */
static char *rung_title(struct making *making, const struct compare_difference *what)
{
	const struct project *project = ladder_project(what->at_b ? making->of->of_b :
						       making->of->of_a);
	const int pou = pou_of(project, what->pou), number = what->at_b ? what->at_b :
							     what->at_a;
	const char *title = what->label && *what->label ? what->label :
		project_text(project, project->pou[pou].rung[number - 1]->title);

	return *title ? g_strdup_printf(_("Rung %d (%s)"), number, title) :
			g_strdup_printf(_("Rung %d"), number);
}

static char *title_of(struct making *making, const struct compare_difference *what)
{
	if (what->rung)
		return rung_title(making, what);
	if (what->group == COMPARE_POU && !what->pou) /* all of it */
		return g_strdup(_("the whole POU"));
	if (what->group == COMPARE_TYPES && what->pou)
		return g_strdup_printf("%s.%s", what->pou, what->subject);
	if (what->subject && *what->subject && what->kind && what->group == COMPARE_CONFIG)
		return g_strdup_printf("%s %s", word(what->kind), what->subject);
	if (what->subject && *what->subject)
		return g_strdup(what->subject);
	return g_strdup(what->kind ? word(what->kind) : _("Properties"));
}

/* A change in this cell or with this property as a line. Caller frees. */
static char *line_of(struct making *making, const struct compare_difference *what,
		     int pou_b)
{
	struct project *b = ladder_project(making->of->of_b);
	GString *line = g_string_new(NULL);
	char letters[PLACE_LETTERS];

	if (what->row)
		g_string_append_printf(line, _("row %d, column %s"), what->row,
			place_column(place_shown(&making->sheet, b, pou_b, what->at_b - 1,
						 what->row - 1, what->col - 1), letters));
	if (what->row && what->subject && *what->subject)
		g_string_append_printf(line, ", %s", what->subject);
	if (what->property)
		g_string_append_printf(line, "%s%s", line->len ? ", " : "",
				       word(what->property));
	if (line->len)
		g_string_append(line, _(": "));
	if (is_change(what, "moved"))
		g_string_append_printf(line, _("moved from %d to %d"), what->at_a, what->at_b);
	else if (what->change)
		g_string_append(line, word(what->change));
	else
		g_string_append_printf(line, "%s" ARROW "%s",
				       *what->from ? what->from : _("nothing"),
				       *what->to ? what->to : _("nothing"));
	return g_string_free(line, FALSE);
}

static enum compare_change change_of(const struct compare_difference *what)
{
	if (what->row || what->property)
		return COMPARE_CHANGED;
	return is_change(what, "added") ? COMPARE_ADDED :
	       is_change(what, "removed") ? COMPARE_REMOVED :
	       is_change(what, "moved") ? COMPARE_MOVED : COMPARE_CHANGED;
}

static void add_detail(struct compare_row *row, const struct compare_difference *what)
{
	const char *label = what->property ? what->property : what->kind;
	struct compare_detail detail = {
		g_strdup(label ? word(label) : ""),
		g_strdup(what->change ? is_change(what, "removed") ? row->title : "" :
			 what->from),
		g_strdup(what->change ? is_change(what, "added") ? row->title : "" :
			 what->to),
	};

	g_array_append_val(row->details, detail);
}

/* ---- a row for a difference ---- */

static bool same_pou(const struct compare_difference *a, const struct compare_difference *b)
{
	return g_strcmp0(a->pou, b->pou) == 0;
}

/* Is this the next line of the same piece of a list? */
static bool follows(const struct compare_difference *last,
		    const struct compare_difference *what)
{
	const bool a = what->at_a ? what->at_a == last->at_a + 1 : true;
	const bool b = what->at_b ? what->at_b == last->at_b + 1 : true;

	return last->line && what->line && a && b;
}

/* Does it belong into the last row? */
static bool joins(const struct making *making, const struct compare_difference *what)
{
	const struct compare_difference *last = &making->last;

	if (!making->of->rows->len || last->group != what->group || !same_pou(last, what))
		return false;
	if (what->line || last->line)
		return follows(last, what);
	if (what->rung || last->rung)
		return last->rung && what->rung && last->at_a == what->at_a &&
		       last->at_b == what->at_b;
	return g_strcmp0(last->kind, what->kind) == 0 &&
	       g_strcmp0(making->subject, what->subject) == 0;
}

/* The place of a declaration in the newer version. */
static void find_declaration(struct making *making, const struct compare_difference *what,
			     struct compare_row *row)
{
	struct project *b = ladder_project(making->of->of_b);
	const uint32_t id = what->subject && g_strcmp0(what->kind, "variable") == 0 ?
		names_find(&b->names, what->subject, strlen(what->subject)) : 0;
	int table = what->group == COMPARE_GLOBALS ? 0 : row->pou_b + 1;

	for (int i = 0; what->group == COMPARE_TYPES && i < b->structure_count; i++)
		if (name_equal(project_text(b, b->structure[i].name), what->pou))
			table = b->pou_count + 1 + i;
	if (!id || (what->group != COMPARE_GLOBALS && table == 0))
		return;
	row->index = vars_find(xref_table(b, table), names_fold(&b->names, id));
	row->table = row->index < 0 ? -1 : table;
}

static void set_shown(struct making *making, const struct compare_difference *what,
		      struct compare_row *row)
{
	const char *name = what->pou ? what->pou : what->subject;

	if (what->group != COMPARE_POU) {
		find_declaration(making, what, row);
		return;
	}
	row->pou_a = pou_of(ladder_project(making->of->of_a), name);
	row->pou_b = pou_of(ladder_project(making->of->of_b), name);
	row->shows = what->rung ? COMPARE_SHOWS_RUNG : what->line ? COMPARE_SHOWS_LINES :
		     !what->pou || g_strcmp0(what->property, "language") == 0 ?
		     COMPARE_SHOWS_POU : COMPARE_SHOWS_TEXT;
	if (what->rung || what->line) {
		row->at_a = what->at_a - 1;
		row->at_b = what->at_b - 1;
	} else {
		find_declaration(making, what, row);
	}
}

static struct compare_row *add_row(struct making *making,
				   const struct compare_difference *what)
{
	struct compare_row *row = row_new(making, group_of(making, what), what->line ?
		g_strdup_printf(_("Line %d"), what->at_b ? what->at_b : what->at_a) :
		title_of(making, what));

	row->change = change_of(what);
	set_shown(making, what, row);
	return row;
}

/* Lines of a list: - and +. */
static void add_lines(struct compare_row *row, const struct compare_difference *what)
{
	if (is_change(what, "removed") || !what->change)
		add_words(row, g_strdup_printf("\xe2\x88\x92 %s", what->change ?
					       what->subject : what->from));
	if (is_change(what, "added") || !what->change)
		add_words(row, g_strdup_printf("+ %s", what->change ? what->subject :
					       what->to));
}

/* ---- charts ---- */

static char *part_title(const struct sfc_sheet *sheet, int shape)
{
	const struct sfc *sfc = sheet->pou->sfc;

	return shape < sfc->step_count ?
	       g_strdup_printf(_("Step %s"), project_text(sheet->project,
							 sfc->step[shape].name)) :
	       g_strdup_printf(_("Transition %s"), sheet->name[shape]);
}

static void add_part(struct making *making, const char *name, const struct diff_part *part,
		     const struct sfc_sheet *before, const struct sfc_sheet *after)
{
	struct compare_row *row = row_new(making, pou_group(making, name),
		part_title(part->b < 0 ? before : after, part->b < 0 ? part->a : part->b));

	row->change = part->a < 0 ? COMPARE_ADDED : part->b < 0 ? COMPARE_REMOVED :
		      COMPARE_CHANGED;
	row->shows = COMPARE_SHOWS_CHART;
	row->pou_a = pou_of(ladder_project(making->of->of_a), name);
	row->pou_b = pou_of(ladder_project(making->of->of_b), name);
	row->at_a = part->a;
	row->at_b = part->b;
	add_words(row, g_strdup(part->words));
}

/* Rows for the steps and transitions of a chart. False: none of them differs. */
static bool add_chart(struct making *making, const char *name, int pou_a, int pou_b)
{
	const struct project *a = ladder_project(making->of->of_a);
	const struct project *b = ladder_project(making->of->of_b);
	struct lettering *lettering = lettering_new(NULL, NULL); /* nothing is measured */
	struct sfc_sheet *before = sfc_sheet_new(a, &a->pou[pou_a], lettering);
	struct sfc_sheet *after = sfc_sheet_new(b, &b->pou[pou_b], lettering);
	GArray *parts = diff_chart_parts(before, after);
	const bool any = parts->len > 0;

	for (guint i = 0; i < parts->len; i++)
		add_part(making, name, &g_array_index(parts, struct diff_part, i), before,
			 after);
	g_array_unref(parts);
	sfc_sheet_free(before);
	sfc_sheet_free(after);
	lettering_free(lettering);
	return any;
}

/* ---- networks ---- */

/* With its label, else its title. */
static char *network_title(const struct project *project, int pou, int index)
{
	const struct fbd_heading heading = fbd_lines_heading(project, &project->pou[pou], index);
	const char *title = heading.label && *heading.label ? heading.label : heading.title;

	return title && *title ? g_strdup_printf(_("Network %d (%s)"), index + 1, title) :
				 g_strdup_printf(_("Network %d"), index + 1);
}

static void add_network(struct making *making, const char *name, const struct diff_network *part, int pou_a,
			int pou_b)
{
	const struct project *a = ladder_project(making->of->of_a);
	const struct project *b = ladder_project(making->of->of_b);
	struct compare_row *row = row_new(making, pou_group(making, name), part->b < 0 ?
		network_title(a, pou_a, part->a) : network_title(b, pou_b, part->b));

	row->change = part->a < 0 ? COMPARE_ADDED : part->b < 0 ? COMPARE_REMOVED :
		      part->moved ? COMPARE_MOVED : COMPARE_CHANGED;
	row->shows = COMPARE_SHOWS_NETWORK;
	row->pou_a = pou_a;
	row->pou_b = pou_b;
	row->at_a = part->a;
	row->at_b = part->b;
	add_words(row, part->moved ? g_strdup_printf(_("moved from %d to %d"), part->a + 1, part->b + 1) :
		  g_strdup(part->words));
}

/* Rows for the networks of a POU. False: none of them differs. */
static bool add_networks(struct making *making, const char *name, int pou_a, int pou_b)
{
	const struct project *a = ladder_project(making->of->of_a);
	const struct project *b = ladder_project(making->of->of_b);
	GArray *parts = diff_networks(a, &a->pou[pou_a], b, &b->pou[pou_b]);
	const bool any = parts->len > 0;

	for (guint i = 0; i < parts->len; i++)
		add_network(making, name, &g_array_index(parts, struct diff_network, i), pou_a, pou_b);
	g_array_unref(parts);
	return any;
}

/* A line of a chart or of networks: all their rows were made at the first line. */
static bool is_of_chart(struct making *making, const struct compare_difference *what)
{
	const struct project *a = ladder_project(making->of->of_a);
	const struct project *b = ladder_project(making->of->of_b);
	const int pou_a = pou_of(a, what->pou), pou_b = pou_of(b, what->pou);

	bool charts, networks;

	if (!what->line || pou_a < 0 || pou_b < 0)
		return false;
	charts = a->pou[pou_a].sfc && b->pou[pou_b].sfc;
	networks = a->pou[pou_a].fbd && b->pou[pou_b].fbd;
	if (!charts && !networks)
		return false;
	if (making->chart != pou_a)
		making->differs = charts ? add_chart(making, what->pou, pou_a, pou_b) :
				  add_networks(making, what->pou, pou_a, pou_b);
	making->chart = pou_a;
	return making->differs;
}

/* ---- all of it ---- */

static void remember(struct making *making, const struct compare_difference *what)
{
	making->last = *what;
	making->last.subject = making->last.property = making->last.from = NULL;
	g_free(making->subject);
	making->subject = g_strdup(what->subject);
}

static void take(void *context, const struct compare_difference *what)
{
	struct making *making = context;
	GPtrArray *rows = making->of->rows;
	struct compare_row *row;

	if (is_of_chart(making, what)) {
		making->last = (struct compare_difference){ .group = COMPARE_PROJECT };
		return;
	}
	row = joins(making, what) ? rows->pdata[rows->len - 1] : add_row(making, what);
	if (row->change != COMPARE_MOVED && row->change != change_of(what))
		row->change = COMPARE_CHANGED;
	if (what->line)
		add_lines(row, what);
	else if (change_of(what) == COMPARE_CHANGED || change_of(what) == COMPARE_MOVED)
		add_words(row, line_of(making, what, row->pou_b));
	if (row->shows == COMPARE_SHOWS_TEXT)
		add_detail(row, what);
	remember(making, what);
}

/* ---- I/O maps ---- */

static void take_map(void *context, const struct iomap_difference *what)
{
	struct making *making = context;
	GPtrArray *rows = making->of->rows;
	struct compare_row *row = rows->len ? rows->pdata[rows->len - 1] : NULL;
	struct compare_detail detail = { g_strdup(what->field ? what->field : ""),
					 g_strdup(what->from), g_strdup(what->to) };

	if (!row || !row->map || strcmp(row->title, what->address) != 0 || !what->field)
		row = row_new(making, g_strdup(_("I/O map")), g_strdup(what->address));
	row->map = true;
	row->change = !what->in_a ? COMPARE_ADDED : !what->in_b ? COMPARE_REMOVED :
		      COMPARE_CHANGED;
	g_array_append_val(row->details, detail);
	add_words(row, what->field ? g_strdup_printf("%s%s%s" ARROW "%s", what->field, _(": "),
		*what->from ? what->from : _("nothing"), *what->to ? what->to : _("nothing")) :
		g_strdup(what->in_a ? what->from : what->to));
}

/* The text of the map of a side; NULL: it has none. Caller frees. */
static char *map_of(const struct compare_side *side)
{
	char *path, *text;
	gsize len;

	if (side->map || side->files || !side->path)
		return g_strdup(side->map);
	path = iomap_beside(side->path);
	text = path ? disk_read(path, LIMIT_TEXT, &len, NULL) : NULL;
	g_free(path);
	return text;
}

static void compare_maps(struct making *making)
{
	char *a = map_of(&making->of->a), *b = map_of(&making->of->b);

	iomap_compare(a, b, take_map, making);
	g_free(a);
	g_free(b);
}

/* ---- sides ---- */

/* Files that a side names. */
struct named_files {
	GHashTable *files;
	char *wanted;        /* the first that is not among them               */
};

/* "sub/../lib.rung" as "lib.rung", as the file is named from the top. NULL: it is above the top.
 * Caller frees. */
static char *name_from_top(const char *path)
{
	char *whole = *path == '/' ? NULL : g_canonicalize_filename(path, "/");
	int depth = 0;
	bool inside = whole;
	char **part = g_strsplit(path, "/", -1);

	for (char **at = part; inside && *at; at++) {
		depth += strcmp(*at, "..") == 0 ? -1 : **at && strcmp(*at, ".") != 0;
		inside = depth >= 0;
	}
	g_strfreev(part);
	path = inside ? whole + 1 : NULL;
	path = g_strdup(path);
	g_free(whole);
	return (char *)path;
}

static char *load_named(void *context, const char *path, size_t *len)
{
	struct named_files *named = context;
	char *name = name_from_top(path), *text = NULL;
	gpointer bytes = NULL;

	if (name && !g_hash_table_lookup_extended(named->files, name, NULL, &bytes) &&
	    !named->wanted)
		named->wanted = g_strdup(name);
	if (bytes) {
		*len = g_bytes_get_size(bytes);
		text = malloc(*len + 1);
	}
	if (text) {
		memcpy(text, g_bytes_get_data(bytes, NULL), *len);
		text[*len] = '\0';
	}
	g_free(name);
	return text;
}

static bool load_from(struct ladder *ladder, const struct compare_side *side)
{
	const char *path = side->path ? side->path : "";

	if (!ladder || !ladder_take_classic(ladder, false) || !ladder_take_others(ladder))
		return false;
	return (side->text ? ladder_load_text(ladder, path, side->text, side->len) :
			     ladder_load(ladder, path)) && ladder_project(ladder);
}

static bool load(struct ladder *ladder, const struct compare_side *side)
{
	struct named_files named = { .files = side->files };
	bool good;

	if (ladder && side->files)
		ladder_set_files(ladder, &(struct ladder_files){ .load = load_named, .context = &named });
	good = load_from(ladder, side);
	if (ladder)
		ladder_set_files(ladder, NULL);
	g_free(named.wanted);
	return good;
}

char *compare_side_wants(const struct compare_side *side)
{
	struct named_files named = { .files = side->files };
	struct ladder *ladder = side->files ? ladder_new() : NULL;

	if (ladder) {
		ladder_set_files(ladder, &(struct ladder_files){ .load = load_named, .context = &named });
		load_from(ladder, side);
	}
	ladder_free(ladder);
	return named.wanted;
}

struct comparison *comparison_new(struct compare_side *a, struct compare_side *b)
{
	struct comparison *of = g_new0(struct comparison, 1);
	struct making making = { .of = of, .chart = -1 };

	*of = (struct comparison){ .a = *a, .b = *b, .of_a = ladder_new(),
		.of_b = ladder_new(), .rows = g_ptr_array_new_with_free_func(row_free) };
	*a = *b = (struct compare_side){ 0 };
	of->read_a = load(of->of_a, &of->a);
	of->read_b = load(of->of_b, &of->b);
	if (of->read_a && of->read_b)
		of->failed = compare_each(ladder_project(of->of_a), ladder_project(of->of_b),
					  take, &making) < 0;
	if (of->read_a && of->read_b)
		compare_maps(&making);
	g_free(making.subject);
	return of;
}

void compare_side_clear(struct compare_side *side)
{
	g_free(side->name);
	g_free(side->path);
	g_free(side->text);
	g_free(side->map);
	g_clear_pointer(&side->files, g_hash_table_unref);
	*side = (struct compare_side){ 0 };
}

struct compare_side compare_side_copy(const struct compare_side *side)
{
	return (struct compare_side){ g_strdup(side->name), g_strdup(side->path),
		side->text ? g_memdup2(side->text, side->len + 1) : NULL, side->len,
		side->files ? g_hash_table_ref(side->files) : NULL, g_strdup(side->map) };
}

void comparison_free(struct comparison *of)
{
	if (!of)
		return;
	g_ptr_array_unref(of->rows);
	ladder_free(of->of_a);
	ladder_free(of->of_b);
	compare_side_clear(&of->a);
	compare_side_clear(&of->b);
	g_free(of);
}

char *comparison_diags(struct ladder *side)
{
	const struct diag_list *diags = side ? ladder_diags(side) : NULL;
	GString *lines = g_string_new(NULL);

	for (int i = 0; diags && i < diags->count; i++) {
		char *line = diag_said_line(&diags->diag[i]);

		g_string_append_printf(lines, "%s%s", i ? "\n" : "", line);
		g_free(line);
	}
	if (!lines->len)
		g_string_append(lines, side ? _("It is a code image, which has no rungs.") :
				g_strerror(ENOMEM));
	return g_string_free(lines, FALSE);
}

static void count_line(void *context, struct compare_line line)
{
	*(int *)context = MAX(*(int *)context, line.line_b);
}

/* Lines of a POU before the first that is compared: its heading and declarations. */
static int lines_before(struct project *project, int pou)
{
	char *text = pou_print(project, &project->pou[pou]);
	int lines = 0, compared = 0;

	for (const char *at = text; at && (at = strchr(at, '\n')); at++)
		lines++;
	compare_lines(project, -1, project, pou, count_line, &compared);
	free(text);
	return MAX(lines - 1 - compared, 0); /* the last one is END_PROGRAM */
}

bool compare_row_place(const struct compare_row *row, struct project *project, int place[4])
{
	const struct sfc *sfc;

	if (row->table >= 0) {
		memcpy(place, (int[]){ -1, -1, row->table, row->index }, 4 * sizeof(int));
		return true;
	}
	if (row->pou_b < 0 || row->pou_b >= project->pou_count ||
	    (row->shows != COMPARE_SHOWS_TEXT && row->shows != COMPARE_SHOWS_POU &&
	     row->at_b < 0))
		return false;
	memcpy(place, (int[]){ row->pou_b, -1, -1, -1 }, 4 * sizeof(int));
	sfc = project->pou[row->pou_b].sfc;
	if (row->shows == COMPARE_SHOWS_RUNG || row->shows == COMPARE_SHOWS_NETWORK)
		place[1] = row->at_b;
	else if (row->shows == COMPARE_SHOWS_LINES)
		place[2] = row->at_b + lines_before(project, row->pou_b);
	else if (row->shows == COMPARE_SHOWS_CHART && sfc)
		place[2] = (row->at_b < sfc->step_count ? sfc->step[row->at_b].line :
			    sfc->transition[row->at_b - sfc->step_count].line) -
			   project->pou[row->pou_b].line;
	return true;
}
