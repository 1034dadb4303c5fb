/* SPDX-License-Identifier: MIT
 *
 * names - commands on the name at the cursor; see names.h.
 */
#include "editor-gtk/window/names.h"

#include "editor-gtk/document/instances.h"
#include "editor-gtk/document/pou_edit.h"
#include "editor-gtk/document/rename.h"
#include "editor-gtk/document/task_rows.h"
#include "editor-gtk/document/type_edit.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/live/watch_view.h"
#include "editor-gtk/panels/task_delete.h"
#include "editor-gtk/panels/uses_view.h"
#include "editor-gtk/window/ask.h"
#include "editor-gtk/window/below.h"
#include "editor-gtk/window/messages.h"
#include "editor-gtk/window/naming.h"
#include "editor-gtk/window/tabs.h"

#include "engine/base/name.h"
#include "engine/xref/xref.h"

#include <stdlib.h>
#include <string.h>

static const char no_name[] = N_("There is no name at the cursor.");

/* ---- what the cursor is on ---- */

static bool is_in_rung(const struct xref_use *use, LadderGridView *sheet)
{
	return use->pou == ladder_canvas_pou(LADDER_CANVAS(sheet)) &&
	       use->rung == ladder_grid_view_first(sheet) +
			    ladder_grid_view_cursor(sheet).rung + 1;
}

static bool is_here(const struct xref_use *use, LadderGridView *sheet, int row, int col)
{
	return is_in_rung(use, sheet) && use->row == row + 1 && use->col == col + 1;
}

static bool is_at_cursor(struct core *core, const struct xref *xref, int here, int use)
{
	LadderGridView *sheet = front_sheet(core->front);
	int row, col;

	return use == here || (sheet && ladder_grid_view_cell(sheet, &row, &col) &&
			       is_here(&xref->use[use], sheet, row, col));
}

/* Does a use in a text have this name? Of a type in a declaration, the name is not kept there. */
static bool is_named(const struct xref *xref, const struct xref_use *use, const char *name)
{
	char text[3 * LIMIT_NAME + 8];

	if (use->slot)
		return name_is(name, xref_text(xref, use) + use->at, use->len);
	if (use->unnamed)
		xref_name(xref->project, &use->target, use, text, sizeof(text));
	return use->unnamed && name_equal(name, text);
}

/* The use of the name at the cursor of a list: in that line, else anywhere in the list. */
static int use_in_list(LadderTextView *list, const struct xref *xref)
{
	char *name = ladder_text_view_name(list);
	int found = -1;

	for (int i = 0; name && i < xref->count; i++) {
		const struct xref_use *use = &xref->use[i];

		if (use->pou != ladder_text_view_pou(list) || use->rung > 0 ||
		    !is_named(xref, use, name))
			continue;
		if (found < 0 || ladder_text_view_is_at(list, use->row))
			found = i;
	}
	g_free(name);
	return found;
}

/* The first use in the cell at the cursor; -1: none. */
static int use_here(struct core *core, const struct xref *xref)
{
	LadderGridView *sheet = front_sheet(core->front);
	int row, col;

	if (front_networks(core->front)) {
		const struct xref_use *use = ladder_fbd_view_use(front_networks(core->front), xref);

		return use ? (int)(use - xref->use) : -1;
	}
	if (!sheet && front_chart(core->front)) {
		const struct xref_use *use = ladder_sfc_view_use(front_chart(core->front), xref);

		return use ? (int)(use - xref->use) : -1;
	}
	if (front_list(core->front))
		return use_in_list(front_list(core->front), xref);
	if (!sheet || !ladder_grid_view_cell(sheet, &row, &col))
		return -1;
	for (int i = 0; i < xref->count; i++)
		if (is_here(&xref->use[i], sheet, row, col))
			return i;
	return -1;
}

static bool find_here(struct core *core, struct xref *xref, int *here)
{
	struct project *project = ladder_document_project(core->document);

	if (!project)
		return false;
	if (!xref_make(xref, project))
		g_error("out of memory");
	*here = use_here(core, xref);
	return *here >= 0;
}

static bool begin(struct core *core, struct xref *xref, int *here)
{
	const bool found = find_here(core, xref, here);

	if (!found && ladder_document_project(core->document))
		messages_tell(core->messages, _(no_name));
	return found;
}

/* ---- going ---- */

static void go_to_use(struct core *core, const struct xref_use *use)
{
	if (use->rung > 0)
		tabs_go(core->tabs, use->pou, use->rung - 1, use->row - 1, use->col - 1);
	else
		tabs_go(core->tabs, use->pou, -1, use->row - 1, use->col - 1);
}

static bool drives(enum xref_kind kind)
{
	return kind == XREF_COIL || kind == XREF_SET || kind == XREF_RESET ||
	       kind == XREF_WRITTEN || kind == XREF_CHANGED || kind == XREF_CALLED ||
	       kind == XREF_ENTERED;
}

/* From a jump the command goes to its label, from a call to the POU; else to what drives
 * the name. */
static bool is_named_place(const struct xref_use *use)
{
	return use->kind == XREF_JUMPED ||
	       (use->target.what == XREF_POU && !use->unnamed);
}

static bool leads(const struct xref_use *from, const struct xref_use *to)
{
	if (to->pou < 0 || to->included || !xref_touches(&to->target, &from->target))
		return false;
	return is_named_place(from) ? to->kind == XREF_DECLARED : drives(to->kind);
}

static const char *lost(const struct xref *xref, int here)
{
	const struct xref_use *use = &xref->use[here];

	if (use->kind == XREF_JUMPED)
		return _("No rung has this label.");
	return is_named_place(use) ? _("It is declared in another file") :
	       _("Nothing in the program drives this name.");
}

/* Goes to the next use that drives the name; after the last, to the first. */
void names_go_driver(struct core *core)
{
	struct xref xref = { 0 };
	int here;

	if (begin(core, &xref, &here)) {
		for (int step = 1; step <= xref.count; step++) {
			const struct xref_use *use = &xref.use[(here + step) % xref.count];

			if (leads(&xref.use[here], use)) {
				go_to_use(core, use);
				xref_free(&xref);
				return;
			}
		}
		messages_tell(core->messages, lost(&xref, here));
	}
	xref_free(&xref);
}

/* Globals and the locals of a ladder stand in a table, those of a text in it. */
static void go_to_declaration(struct core *core, const struct xref_use *use)
{
	struct project *project = ladder_document_project(core->document);
	const struct xref_target *target = &use->target;
	int table = -1, index = target->index;

	if (target->what == XREF_VARIABLE)
		table = target->table;
	else if (target->what == XREF_STRUCTURE || target->what == XREF_NAMED)
		tabs_show_type(core->tabs, project_text(project, *use->slot));
	else if (target->what != XREF_VALUE ||
		 !xref_value_owner(project, target->index, &table, &index))
		go_to_use(core, use);
	if (table > project->pou_count) {
		const char *type = type_name(project, table - project->pou_count - 1);

		if (target->what == XREF_VALUE)
			tabs_show_value(core->tabs, type, project_text(project, *use->slot));
		else
			tabs_show_type(core->tabs, type);
	} else if (table >= 0 && use->pou >= 0 && project->pou[use->pou].language != LANGUAGE_LD &&
		   !project->pou[use->pou].sfc) { /* behind the blanks of its line */
		tabs_go(core->tabs, use->pou, -1, use->line - project->pou[use->pou].line, 2);
	} else if (table >= 0) {
		tabs_go(core->tabs, -1, -1, table, index);
	}
}

static const struct xref_use *declared(const struct xref *xref, const struct xref_use *of)
{
	for (int i = 0; i < xref->count; i++)
		if (xref->use[i].kind == XREF_DECLARED && !xref->use[i].included &&
		    xref_same(&xref->use[i].target, &of->target))
			return &xref->use[i];
	return NULL;
}

void names_go_definition(struct core *core)
{
	struct xref xref = { 0 };
	const struct xref_use *use = NULL;
	bool found;
	int here;

	found = begin(core, &xref, &here);
	use = found ? declared(&xref, &xref.use[here]) : NULL;
	if (use && use != &xref.use[here])
		go_to_declaration(core, use);
	else if (found && !use)
		messages_tell(core->messages, _("It is declared in another file"));
	if (found && use == &xref.use[here])
		names_go_driver(core);
	xref_free(&xref);
}

/* ---- all uses ---- */

/* Main.Delay. @use: of an undeclared name. Owns: the caller. */
static char *whole_name(const struct xref *xref, const struct xref_use *use)
{
	char text[3 * LIMIT_NAME + 8];

	xref_name(xref->project, &use->target, use, text, sizeof(text));
	return g_strdup(text);
}

static char *name_by(struct core *core,
		     bool (*find)(struct core *core, struct xref *xref, int *here))
{
	struct xref xref = { 0 };
	char name[400] = "";
	int here = -1;

	if (find(core, &xref, &here))
		xref_name(ladder_document_project(core->document), &xref.use[here].target,
			  &xref.use[here], name, sizeof(name));
	xref_free(&xref);
	return name[0] ? g_strdup(name) : NULL;
}

char *names_at_cursor(struct core *core)
{
	return name_by(core, begin);
}

/* The panel became visible. */
static void uses_seen(GtkWidget *uses, struct core *core)
{
	char *name = name_by(core, find_here);

	if (name)
		ladder_uses_view_set_symbol(LADDER_USES_VIEW(uses), -1, name);
	g_free(name);
}

/* If the panel has lost its name, it shows the one at the cursor. */
static void cursor_moved(struct core *core)
{
	GtkWidget *uses = below_made(core->below, "uses");

	if (uses && gtk_widget_get_mapped(uses) &&
	    ladder_uses_view_is_lost(LADDER_USES_VIEW(uses)))
		uses_seen(uses, core);
}

/* As find_here(); a rung without a name at the cursor gives its label. */
static bool find_label(struct core *core, struct xref *xref, int *here)
{
	LadderGridView *sheet = front_sheet(core->front);

	if (find_here(core, xref, here) || !sheet || !xref->project)
		return *here >= 0;
	for (int i = 0; i < xref->count && *here < 0; i++) {
		const struct xref_use *use = &xref->use[i];

		if (use->target.what == XREF_LABEL && use->kind == XREF_DECLARED &&
		    is_in_rung(use, sheet))
			*here = i;
	}
	return *here >= 0;
}

/* The names in the cell at the cursor of a ladder, as "Main.Delay", each once. */
static GPtrArray *names_in_cell(struct core *core, const struct xref *xref, int here)
{
	GPtrArray *names = g_ptr_array_new_with_free_func(g_free);

	for (int i = here; i < xref->count; i++) {
		char *name = xref->use[i].unnamed || !is_at_cursor(core, xref, here, i) ? NULL :
			     whole_name(xref, &xref->use[i]);

		if (name && !g_ptr_array_find_with_equal_func(names, name, g_str_equal, NULL))
			g_ptr_array_add(names, name);
		else
			g_free(name);
	}
	return names;
}

/* Where the cursor is: of two presses at one place, the second one lists the next name. NULL: no
 * cell. Caller: g_free(). */
static char *place_here(struct core *core)
{
	LadderGridView *sheet = front_sheet(core->front);
	int row, col;

	if (!sheet || !ladder_grid_view_cell(sheet, &row, &col))
		return NULL;
	return g_strdup_printf("%d %d %d %d", ladder_canvas_pou(LADDER_CANVAS(sheet)),
			       ladder_grid_view_first(sheet) + ladder_grid_view_cursor(sheet).rung,
			       row, col);
}

/* The name in the cell behind the one that the panel lists for this place; else the first one.
 * NULL: there is none. Caller: g_free(). */
static char *next_name(struct core *core, GtkWidget *uses, const char *place)
{
	struct xref xref = { 0 };
	char *name = NULL;
	int here;
	guint at = 0;

	if (place && find_here(core, &xref, &here)) {
		GPtrArray *names = names_in_cell(core, &xref, here);

		if (g_strcmp0(g_object_get_data(G_OBJECT(uses), "place"), place) == 0 &&
		    g_ptr_array_find_with_equal_func(names, ladder_uses_view_symbol(
			    LADDER_USES_VIEW(uses)), g_str_equal, &at))
			at = (at + 1) % names->len;
		name = names->len ? g_strdup(names->pdata[at]) : NULL;
		g_ptr_array_unref(names);
	}
	xref_free(&xref);
	return name;
}

void names_show_uses(struct core *core)
{
	GtkWidget *uses = below_made(core->below, "uses");
	char *place = place_here(core);
	char *name = uses ? next_name(core, uses, place) : NULL;

	if (!name)
		name = name_by(core, find_label);
	if (name) {
		names_show_uses_of(core, name);
		g_object_set_data_full(G_OBJECT(below_made(core->below, "uses")), "place", place,
				       g_free);
		place = NULL;
	} else {
		messages_tell(core->messages, _(no_name));
		ladder_uses_view_set_mode(LADDER_USES_VIEW(below_show(core->below, "uses")),
					  USES_ALL);
	}
	g_free(place);
	g_free(name);
}

void names_watch_this(struct core *core, const char *name)
{
	ladder_watch_view_add(LADDER_WATCH_VIEW(below_show(core->below, "watch")), name);
}

/* A variable of a function block has no value of its own: each instance has one. Returns the
 * shown instance, else the first one that is declared; NULL: no variable of a block, or there is no
 * instance. Caller: g_free(). */
static char *instance_of(struct core *core, const struct xref_target *target)
{
	const struct project *project = ladder_document_project(core->document);
	LadderGridView *sheet = front_sheet(core->front);
	const char *shown = sheet ? ladder_grid_view_instance(sheet) : NULL;
	const int pou = target->table - 1;

	if ((target->what != XREF_VARIABLE && target->what != XREF_STEP) || pou < 0 ||
	    pou >= project->pou_count || project->pou[pou].kind != POU_BLOCK)
		return NULL;
	return shown && ladder_canvas_pou(LADDER_CANVAS(sheet)) == pou ? g_strdup(shown) :
	       instance_first(project, pou);
}

/* The name of a use as the status chart takes it: "Main.Delay", "Main.Lift.Up" of a variable of
 * Lift, "Main.Fill.X" of a step. Caller: g_free(). */
static char *watched_name(struct core *core, const struct xref_use *use)
{
	const bool step = !front_sheet(core->front) && front_chart(core->front) &&
			  use->target.what == XREF_STEP;
	char *instance = instance_of(core, &use->target), *watched;
	char name[400] = "";
	const char *inside;

	xref_name(ladder_document_project(core->document), &use->target, use, name, sizeof(name));
	inside = instance ? strchr(name, '.') : NULL;
	watched = g_strconcat(inside ? instance : "", inside ? inside : name, step ? ".X" : NULL,
			      NULL);
	g_free(instance);
	return watched;
}

/* Adds the name at the cursor to the status chart; for a step, Step.X. */
void names_watch(struct core *core)
{
	struct xref xref = { 0 };
	int here;
	char *name = begin(core, &xref, &here) ? watched_name(core, &xref.use[here]) : NULL;

	names_watch_this(core, name ? name : "");
	g_free(name);
	xref_free(&xref);
}

void names_show_uses_of(struct core *core, const char *name)
{
	GtkWidget *uses = below_show(core->below, "uses");

	ladder_uses_view_set_symbol(LADDER_USES_VIEW(uses), -1, name);
	ladder_uses_view_set_mode(LADDER_USES_VIEW(uses), USES_SYMBOL);
}

/* ---- another name ---- */

/* A wire of a network (model/fbd.h)? */
static bool is_wire(const struct xref *xref, const struct xref_target *target)
{
	return target->what == XREF_VARIABLE && target->table > 0 && target->table <= xref->project->pou_count &&
	       vars_flags(xref_table(xref->project, target->table), target->index) & VAR_WIRE;
}

struct named {
	struct xref_target target;
	char *name;          /* the current name                              */
	char *whole;         /* Main.Delay: finds it after another change      */
	int uses;
};

struct renaming {
	struct core *core;
	struct naming *naming;
	GArray *choice;      /* of struct named, at least one                 */
	guint chosen;
	guint64 version;     /* of the document that @choice has the numbers of */
};

static struct named *chosen_of(const struct renaming *renaming)
{
	return &g_array_index(renaming->choice, struct named, renaming->chosen);
}

/* The numbers of @named now; false: it is gone. */
static bool find_named(const struct xref *xref, struct named *named)
{
	bool found = false;

	for (int i = 0; i < xref->count && !found; i++) {
		const struct xref_use *use = &xref->use[i];
		char *whole = (use->kind == XREF_DECLARED || is_wire(xref, &use->target)) &&
			      use->target.what == named->target.what ?
			whole_name(xref, use) : NULL;

		found = g_strcmp0(whole, named->whole) == 0;
		if (found)
			named->target = use->target;
		g_free(whole);
	}
	return found;
}

/* Finds the names again after another change: a POU or a declaration before them may be new.
 * False: the chosen one is gone. */
static bool find_again(struct renaming *renaming)
{
	LadderDocument *document = renaming->core->document;
	struct project *project = ladder_document_project(document);
	struct xref xref = { 0 };
	bool found = true;

	if (ladder_document_version(document) == renaming->version)
		return true;
	if (!project)
		return false;
	if (!xref_make(&xref, project))
		g_error("out of memory");
	found = find_named(&xref, chosen_of(renaming));
	xref_free(&xref);
	return found;
}

static void rename_target(struct core *core, const struct named *named, const char *name)
{
	char *step = g_strdup_printf(_("Rename %s to %s"), named->name, name);
	char *told = NULL;
	int places;

	if (rename_everywhere(core->document, &named->target, name, step, &places, &told))
		told = g_strdup_printf(ngettext("%d place changed", "%d places changed",
						(unsigned long)places), places);
	messages_tell(core->messages, told);
	g_free(told);
	g_free(step);
}

static char *refusal(gpointer data, const char *name)
{
	struct renaming *renaming = data;
	struct named *named = chosen_of(renaming);

	if (!find_again(renaming))
		return g_strdup(_("It is not there any more"));
	if (strcmp(name, named->name) == 0)
		return NULL;
	return *name ? rename_refusal(renaming->core->document, &named->target, name) :
		       g_strdup(_("Enter a name"));
}

/* The files beside the project that have the name, and its charts, a line each. */
static void list_files(struct renaming *renaming, GString *body)
{
	const struct named *named = chosen_of(renaming);
	char *why = NULL;
	GPtrArray *files = rename_files(renaming->core->document, &named->target, NULL, &why);

	for (guint i = 0; files && i < files->len; i++) {
		const struct rename_file *file = files->pdata[i];
		char *name = file->path ? g_path_get_basename(file->path) :
					  g_strdup(_("Status and timing charts"));

		g_string_append_c(body, '\n');
		g_string_append_printf(body, ngettext("%s: %d place", "%s: %d places",
						      (unsigned long)file->places), name,
				       file->places);
		g_free(name);
	}
	if (files)
		g_ptr_array_unref(files);
	g_free(why);
}

static void show_chosen(struct renaming *renaming)
{
	const struct named *named = chosen_of(renaming);
	GString *body = g_string_new(NULL);

	g_string_printf(body, ngettext("“%s” is used in %d place.", "“%s” is used in %d places.",
				       (unsigned long)named->uses), named->name, named->uses);
	list_files(renaming, body);
	naming_say(renaming->naming, body->str);
	g_string_free(body, TRUE);
	naming_set(renaming->naming, named->name);
}

static void choose(GtkDropDown *list, GParamSpec *spec, struct renaming *renaming)
{
	const guint chosen = gtk_drop_down_get_selected(list);

	(void)spec;
	if (chosen >= renaming->choice->len)
		return;
	renaming->chosen = chosen;
	show_chosen(renaming);
}

static void rename_now(gpointer data, const char *name)
{
	struct renaming *renaming = data;
	struct named *named = chosen_of(renaming);

	if (!find_again(renaming))
		messages_warn(renaming->core->messages, _("It is not there any more"));
	else if (strcmp(name, named->name) != 0)
		rename_target(renaming->core, named, name);
}

static void renaming_free(gpointer data)
{
	struct renaming *renaming = data;

	g_array_unref(renaming->choice);
	g_free(renaming);
}

static const struct naming_how how = { refusal, rename_now, renaming_free };

/* Hidden if there is only one choice. */
static GtkWidget *choice_new(struct renaming *renaming)
{
	GtkStringList *names = gtk_string_list_new(NULL);
	GtkWidget *list;

	for (guint i = 0; i < renaming->choice->len; i++)
		gtk_string_list_append(names, g_array_index(renaming->choice, struct named,
							    i).name);
	list = gtk_drop_down_new(G_LIST_MODEL(names), NULL);
	gtk_widget_set_visible(list, renaming->choice->len > 1);
	spoken_name(list, _("Which name"));
	g_signal_connect(list, "notify::selected", G_CALLBACK(choose), renaming);
	return list;
}

/* @choice: taken over. */
static void ask_name(struct core *core, GArray *choice)
{
	struct renaming *renaming = g_new0(struct renaming, 1);

	*renaming = (struct renaming){ .core = core, .choice = choice,
		.version = ladder_document_version(core->document) };
	renaming->naming = naming_new(core->window, _("Rename everywhere"), _("Rename"),
				      _("New name"), &how, renaming);
	naming_add(renaming->naming, choice_new(renaming), true);
	show_chosen(renaming);
	naming_show(renaming->naming);
}

/* The name, as it is declared; that of a wire, which is declared nowhere, without the number of its network.
 * NULL: it has none. Caller frees. */
static char *own_name(const struct xref *xref, const struct xref_target *target)
{
	if (is_wire(xref, target)) {
		const char *name = project_text(xref->project,
			xref_table(xref->project, target->table)->var[target->index].name);

		return g_strndup(name, (gsize)(strrchr(name, '.') - name));
	}
	for (int i = 0; i < xref->count; i++) {
		const struct xref_use *use = &xref->use[i];

		if (use->kind == XREF_DECLARED && use->slot &&
		    xref_same(&use->target, target))
			return g_strdup(project_text(xref->project, *use->slot));
	}
	return NULL;
}

static void named_clear(gpointer named)
{
	g_free(((struct named *)named)->name);
	g_free(((struct named *)named)->whole);
}

static GArray *choice_start(void)
{
	GArray *choice = g_array_new(FALSE, FALSE, sizeof(struct named));

	g_array_set_clear_func(choice, named_clear);
	return choice;
}

/* Adds the target if it is declared and not in @choice. */
static void choice_add(GArray *choice, const struct xref *xref,
		       const struct xref_target *target)
{
	struct named named = { .target = *target };

	for (guint i = 0; i < choice->len; i++)
		if (xref_same(&g_array_index(choice, struct named, i).target, target))
			return;
	named.name = own_name(xref, target);
	if (!named.name)
		return;
	named.whole = whole_name(xref, &(struct xref_use){ .target = *target });
	for (int i = 0; i < xref->count; i++)
		named.uses += xref_same(&xref->use[i].target, target);
	g_array_append_val(choice, named);
}

/* First the name written in the cell, then names that only its box stands for: the instance
 * before the block type. */
static GArray *choice_here(struct core *core, const struct xref *xref, int here)
{
	GArray *choice = choice_start();

	for (int unnamed = 0; unnamed < 2; unnamed++)
		for (int i = here; i < xref->count; i++)
			if (xref->use[i].unnamed == (unnamed == 1) &&
			    is_at_cursor(core, xref, here, i))
				choice_add(choice, xref, &xref->use[i].target);
	return choice;
}

void names_rename(struct core *core)
{
	struct xref xref = { 0 };
	int here;

	if (find_label(core, &xref, &here)) {
		GArray *choice = choice_here(core, &xref, here);

		if (choice->len) {
			ask_name(core, choice);
		} else {
			messages_tell(core->messages, _("Only declared names can be renamed; "
							"this name has no declaration."));
			g_array_unref(choice);
		}
	} else if (ladder_document_project(core->document)) {
		messages_tell(core->messages, _(no_name));
	}
	xref_free(&xref);
}

static void rename_declared(struct core *core, enum xref_what what, int index)
{
	struct project *project = ladder_document_project(core->document);
	const struct xref_target target = { .what = what, .index = index };
	struct xref xref = { 0 };
	GArray *choice = choice_start();

	if (project && !xref_make(&xref, project))
		g_error("out of memory");
	choice_add(choice, &xref, &target);
	if (choice->len)
		ask_name(core, choice);
	else
		g_array_unref(choice);
	xref_free(&xref);
}

void names_rename_pou(struct core *core, int pou)
{
	rename_declared(core, XREF_POU, pou);
}

void names_rename_type(struct core *core, int type)
{
	const struct project *project = ladder_document_project(core->document);
	const struct xref_target target = project ? type_target(project, type) :
					  (struct xref_target){ .what = XREF_UNKNOWN };

	rename_declared(core, target.what, target.index);
}

/* ---- deleting a POU or a data type ---- */

struct deleting {
	struct core *core;
	char *name;
	bool type;           /* a data type                                    */
};

static void deleting_free(gpointer data, GClosure *closure)
{
	struct deleting *deleting = data;

	(void)closure;
	g_free(deleting->name);
	g_free(deleting);
}

static void delete_pou(struct core *core, int pou)
{
	const char *why = pou_delete(core->document, pou);

	if (why)
		messages_tell(core->messages, why);
}

static void delete_type(struct core *core, int type)
{
	char *why;

	if (!type_delete(core->document, type, &why))
		messages_tell(core->messages, why);
	g_free(why);
}

static void delete_named(const struct deleting *deleting)
{
	const struct project *project = ladder_document_project(deleting->core->document);
	const int number = !project ? -1 : deleting->type ?
		type_find(deleting->core->document, deleting->name) :
		project_find_pou(project, deleting->name, strlen(deleting->name));

	if (number >= 0 && deleting->type)
		delete_type(deleting->core, number);
	else if (number >= 0)
		delete_pou(deleting->core, number);
}

static void delete_answered(AdwMessageDialog *dialog, const char *answer,
			    struct deleting *deleting)
{
	(void)dialog;
	if (strcmp(answer, "uses") == 0)
		names_show_uses_of(deleting->core, deleting->name);
	else if (strcmp(answer, "delete") == 0)
		delete_named(deleting);
}

static void append_user(GString *body, const char *user, int uses)
{
	if (!uses)
		return;
	g_string_append_c(body, '\n');
	g_string_append_printf(body, ngettext("%s: %d place", "%s: %d places",
					      (unsigned long)uses), user, uses);
}

/* The POUs that use it and the symbols, a line each; a long list ends with "…". */
static void list_users(struct core *core, const struct xref_target *target, GString *body)
{
	enum { USERS = 6 };
	struct project *project = ladder_document_project(core->document);
	int *uses = g_new0(int, (gsize)project->pou_count + 1);
	int users = 0;
	struct xref xref = { 0 };

	if (!xref_make(&xref, project))
		g_error("out of memory");
	for (int i = 0; i < xref.count; i++)
		if (xref_same(&xref.use[i].target, target) && xref.use[i].kind != XREF_DECLARED)
			uses[xref.use[i].pou + 1]++;
	if (target->what == XREF_POU)
		uses[target->index + 1] = 0;
	for (int i = 0; i <= project->pou_count; i++) {
		if (uses[i] && ++users > USERS) {
			g_string_append(body, "\n…");
			break;
		}
		append_user(body, i ? project_text(project, project->pou[i - 1].name) :
				      _("Symbols"), uses[i]);
	}
	xref_free(&xref);
	g_free(uses);
}

static void ask_delete(struct core *core, const struct xref_target *target, const char *name,
		       int uses)
{
	const bool type = target->what != XREF_POU;
	struct deleting *deleting = g_new(struct deleting, 1);
	char *heading = g_strdup_printf(_("Delete “%s”?"), name);
	GString *body = g_string_new(NULL);

	g_string_printf(body, type ? ngettext(
		"It is used in %d place. Variables and members of this type are deleted, too.",
		"It is used in %d places. Variables and members of this type are deleted, too.",
		(unsigned long)uses) : ngettext(
		"It is used in %d place. Its boxes and instances are deleted, too.",
		"It is used in %d places. Its boxes and instances are deleted, too.",
		(unsigned long)uses), uses);
	list_users(core, target, body);
	AdwMessageDialog *dialog = ask_new(core->window, heading, body->str, "uses",
					   _("Show uses"), ADW_RESPONSE_DEFAULT);

	adw_message_dialog_add_response(dialog, "delete", _("Delete anyway"));
	adw_message_dialog_set_response_appearance(dialog, "delete",
						   ADW_RESPONSE_DESTRUCTIVE);
	*deleting = (struct deleting){ core, g_strdup(name), type };
	g_signal_connect_data(dialog, "response", G_CALLBACK(delete_answered), deleting,
			      deleting_free, 0);
	gtk_window_present(GTK_WINDOW(dialog));
	g_string_free(body, TRUE);
	g_free(heading);
}

void names_delete_pou(struct core *core, int pou)
{
	const struct project *project = ladder_document_project(core->document);
	const struct xref_target target = { .what = XREF_POU, .index = pou };
	const int uses = project ? pou_uses(core->document, pou) : 0;

	if (uses > 0 && project->pou_count > 1 && !project->pou[pou].included)
		ask_delete(core, &target, project_text(project, project->pou[pou].name), uses);
	else
		delete_pou(core, pou);
}

void names_delete_type(struct core *core, int type)
{
	const struct project *project = ladder_document_project(core->document);
	const struct xref_target target = type_target(project, type);
	const int uses = type_uses(core->document, type);

	if (uses > 0 && !type_is_included(core->document, type))
		ask_delete(core, &target, type_name(project, type), uses);
	else
		delete_type(core, type);
}

/* ---- tasks ---- */

/* The row of a task; -1: "Each scan", which is no task, and the status bar says so. */
static int task_of(struct core *core, const char *name)
{
	struct task_rows *tasks = task_rows_new(core->document);
	const int row = task_rows_find(tasks, TASKS_TASK, name);

	task_rows_free(tasks);
	if (row < 0)
		messages_tell(core->messages, _("“Each scan” is not a task: it lists the programs "
						"without a task. It cannot be renamed or deleted"));
	return row;
}

static void task_deleted(gpointer window, bool good, char *why)
{
	if (!good)
		gtk_widget_activate_action(window, "win.warn", "s", why ? why : "");
	g_free(why);
}

void names_delete_task(struct core *core, const char *name)
{
	if (task_of(core, name) >= 0)
		task_delete_ask(core->window, core->document, TASKS_TASK, name, task_deleted,
				G_OBJECT(core->window));
}

/* A task that gets another name. */
struct task_named {
	struct core *core;
	char *name;
};

static void task_named_free(gpointer data)
{
	struct task_named *named = data;

	g_free(named->name);
	g_free(named);
}

static char *task_refusal(gpointer data, const char *name)
{
	const struct task_named *named = data;

	return task_rows_name_refusal(named->core->document, task_of(named->core, named->name),
				      name);
}

static void task_renamed(gpointer data, const char *name)
{
	const struct task_named *named = data;
	char *why = NULL;

	if (!task_rows_set(named->core->document, task_of(named->core, named->name), TASKS_NAME,
			   name, &why))
		messages_warn(named->core->messages, why ? why : "");
	g_free(why);
}

static const struct naming_how task_naming = { task_refusal, task_renamed, task_named_free };

void names_rename_task(struct core *core, const char *name)
{
	struct task_named *named;
	struct naming *naming;

	if (task_of(core, name) < 0)
		return;
	named = g_new(struct task_named, 1);
	*named = (struct task_named){ core, g_strdup(name) };
	naming = naming_new(core->window, _("Rename task"), _("Rename"), _("Name"), &task_naming,
			    named);
	naming_set(naming, name);
	naming_show(naming);
}

/* ---- the panel ---- */

static GtkWidget *make_uses(gpointer data)
{
	struct core *core = data;
	GtkWidget *uses = ladder_uses_view_new();

	ladder_uses_view_set_document(LADDER_USES_VIEW(uses), core->document);
	core_connect(core, uses, "map", G_CALLBACK(uses_seen), core, 0);
	core_connect(core, uses, "lost", G_CALLBACK(uses_seen), core, 0);
	return uses;
}

void names_add_panel(struct core *core)
{
	below_add(core->below, "uses", N_("Cross reference"), make_uses, core);
	core_connect(core, core->window, "cursor-moved", G_CALLBACK(cursor_moved), core,
		     G_CONNECT_SWAPPED);
}
