/* SPDX-License-Identifier: MIT
 *
 * type_cells - choices and forms for declarations; see type_cells.h.
 */
#include "editor-gtk/panels/type_cells.h"

#include "editor-gtk/document/init_form.h"
#include "editor-gtk/document/symbols.h"
#include "editor-gtk/document/type_edit.h"
#include "editor-gtk/kit/cells.h"
#include "editor-gtk/kit/gtk48/popover.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/panels/init_dialog.h"

#include "engine/base/name.h"
#include "engine/xref/xref.h"

#include <stdlib.h>
#include <string.h>

/* ---- choices ---- */

static void add(GPtrArray *choices, const char *text, const char *about)
{
	g_ptr_array_add(choices, g_strdup(text));
	g_ptr_array_add(choices, g_strdup(about));
}

static void add_blocks(GPtrArray *choices, const struct project *project)
{
	for (int i = 0; i < project->pou_count; i++)
		if (project->pou[i].kind == POU_BLOCK)
			add(choices, project_text(project, project->pou[i].name),
			    _("function block"));
	for (int i = 0; i < (int)WORD_COUNT; i++) {
		const struct word_row *row = word_row((enum word)i);

		if (row->kind == WORD_FB)
			add(choices, row->word, said(words_explain(row)));
	}
}

GPtrArray *type_cells_choices(LadderDocument *document, bool member)
{
	const struct project *project = ladder_document_project(document);
	GPtrArray *choices = g_ptr_array_new_with_free_func(g_free);

	for (int i = IEC_NONE + 1; i < IEC_TYPE_COUNT; i++)
		add(choices, iec_type_row((enum iec_type)i)->word, "");
	for (int i = 0; project && i < type_count(project); i++)
		if (type_is(project, i))
			add(choices, type_name(project, i), type_kind_name(type_kind_of(project, i)));
	if (project && !member)
		add_blocks(choices, project);
	return choices;
}

static bool has_form(const LadderPanelRow *row, int field)
{
	return field == FIELD_TYPE ||
	       (field == FIELD_INITIAL && row->flags & TYPE_CELLS_PARTS);
}

static const char *form_name(int field)
{
	return field == FIELD_TYPE ? _("Array…") : _("Edit the values… (Ctrl+Space)");
}

void type_cells_join(struct panel_cells *cells)
{
	cells->choosable |= 1u << FIELD_TYPE;
	cells->completing |= 1u << FIELD_TYPE;
	cells->has_form = has_form;
	cells->form_name = form_name;
}

unsigned int type_cells_flags(LadderDocument *document, int table, int index)
{
	struct project *project = ladder_document_project(document);

	return init_form_has(project, &xref_table(project, table)->var[index]) ?
	       TYPE_CELLS_PARTS : 0;
}

/* ---- the form of an array ---- */

struct array_form {
	GtkWidget *popover, *low, *high, *type, *why;
	GtkWidget *cell;
	LadderPanelRow *row;
	char *written[2]; /* the bounds before: "0", "Limit - 1"               */
};

static void array_form_free(gpointer data)
{
	struct array_form *form = data;

	g_object_unref(form->cell);
	g_object_unref(form->row);
	g_free(form->written[0]);
	g_free(form->written[1]);
	g_free(form);
}

/* The bounds of "ARRAY[0..Limit - 1] OF INT" as they are written, and the type of its elements; of
 * another type those of a new array. Caller frees the bounds. */
static const char *read_array(const char *text, char *bounds[2])
{
	const char *of = strstr(text, "] OF "), *dots = strstr(text, "..");
	const bool is_array = of && dots && dots < of && g_str_has_prefix(text, "ARRAY[");
	const char *first = text + strlen("ARRAY["), *last = dots + strlen("..");

	bounds[0] = is_array ? g_strstrip(g_strndup(first, (gsize)(dots - first))) : g_strdup("0");
	bounds[1] = is_array ? g_strstrip(g_strndup(last, (gsize)(of - last))) : g_strdup("9");
	return is_array ? of + strlen("] OF ") : text;
}

static char *bound_text(GtkWidget *entry)
{
	return g_strstrip(g_strdup(gtk_editable_get_text(GTK_EDITABLE(entry))));
}

/* A whole number; or the expression that stands there already, which is not computed here. False:
 * it is neither. */
static bool read_bound(const struct array_form *form, GtkWidget *entry, long *out, bool *known)
{
	char *text = bound_text(entry), *end;

	*out = strtol(text, &end, 10);
	*known = *text && !*end;
	const bool good = *known ? *out >= G_MININT32 && *out <= G_MAXINT32 :
			  *text && strcmp(text, form->written[entry == form->high]) == 0;

	g_free(text);
	return good;
}

/* Why the bounds are refused, translated, static; NULL: they are right. @at: gets the wrong entry. */
static const char *bounds_refusal(const struct array_form *form, GtkWidget **at)
{
	bool known_low, known_high;
	long low, high;

	*at = form->low;
	if (!read_bound(form, form->low, &low, &known_low))
		return _("A whole number is needed");
	*at = form->high;
	if (!read_bound(form, form->high, &high, &known_high))
		return _("A whole number is needed");
	if (!known_low || !known_high)
		return NULL;
	if (high < low)
		return _("The last index is below the first");
	return high - low >= LIMIT_ELEMENTS ? _("An array has at most 1000000 elements") : NULL;
}

static bool show_refusal(struct array_form *form)
{
	GtkWidget *at;
	const char *why = bounds_refusal(form, &at);

	cells_refuse(form->low, why && at == form->low ? g_strdup(why) : NULL);
	cells_refuse(form->high, why && at == form->high ? g_strdup(why) : NULL);
	popover_tell(GTK_LABEL(form->why), why ? why : "");
	return why;
}

static void bounds_changed(struct array_form *form)
{
	show_refusal(form);
}

static void make_array(struct array_form *form)
{
	GtkStringObject *type = gtk_drop_down_get_selected_item(GTK_DROP_DOWN(form->type));
	GtkWidget *cell = form->cell;
	char *low, *high, *text;

	if (show_refusal(form) || !type)
		return;
	low = bound_text(form->low);
	high = bound_text(form->high);
	text = g_strdup_printf("ARRAY[%s..%s] OF %s", low, high,
			       gtk_string_object_get_string(type));
	g_free(low);
	g_free(high);
	g_object_ref(cell);
	gtk_popover_popdown(GTK_POPOVER(form->popover));
	gtk_widget_grab_focus(cell);
	if (panel_cells_row(cell) == form->row)
		panel_cells_take(cell, text);
	g_object_unref(cell);
	g_free(text);
}

static GtkWidget *bound_new(struct array_form *form, const char *text, const char *name)
{
	GtkWidget *entry = gtk_entry_new();

	gtk_editable_set_text(GTK_EDITABLE(entry), text);
	gtk_editable_set_width_chars(GTK_EDITABLE(entry), 8);
	gtk_editable_set_max_width_chars(GTK_EDITABLE(entry), 8);
	spoken_name(entry, name);
	g_signal_connect_swapped(entry, "changed", G_CALLBACK(bounds_changed), form);
	g_signal_connect_swapped(entry, "activate", G_CALLBACK(make_array), form);
	return entry;
}

/* The types of elements, with @now selected. */
static GtkWidget *types_new(LadderDocument *document, bool member, const char *now)
{
	GPtrArray *choices = type_cells_choices(document, member);
	GtkStringList *names = gtk_string_list_new(NULL);
	guint selected = GTK_INVALID_LIST_POSITION, count = 0;
	GtkWidget *drop;

	for (guint i = 0; i + 1 < choices->len; i += 2, count++) {
		gtk_string_list_append(names, choices->pdata[i]);
		if (name_equal(choices->pdata[i], now))
			selected = count;
	}
	if (selected == GTK_INVALID_LIST_POSITION) { /* STRING[20] */
		gtk_string_list_append(names, now);
		selected = count;
	}
	drop = gtk_drop_down_new(G_LIST_MODEL(names), gtk_property_expression_new(
		GTK_TYPE_STRING_OBJECT, NULL, "string"));
	gtk_drop_down_set_enable_search(GTK_DROP_DOWN(drop), TRUE);
	gtk_drop_down_set_selected(GTK_DROP_DOWN(drop), selected);
	spoken_name(drop, _("Type of the elements"));
	g_ptr_array_unref(choices);
	return drop;
}

static void attach(GtkGrid *grid, int line, const char *name, GtkWidget *widget)
{
	GtkWidget *label = gtk_label_new(name);

	gtk_label_set_xalign(GTK_LABEL(label), 0);
	gtk_grid_attach(grid, label, 0, line, 1, 1);
	gtk_grid_attach(grid, widget, 1, line, 1, 1);
}

static GtkWidget *array_parts(struct array_form *form)
{
	GtkWidget *grid = gtk_grid_new(), *button = gtk_button_new_with_label(_("Set the type"));

	form->why = gtk_label_new("");
	gtk_label_set_xalign(GTK_LABEL(form->why), 0);
	gtk_label_set_wrap(GTK_LABEL(form->why), TRUE);
	gtk_label_set_max_width_chars(GTK_LABEL(form->why), 30);
	gtk_widget_add_css_class(form->why, "error");
	gtk_widget_add_css_class(button, "suggested-action");
	g_signal_connect_swapped(button, "clicked", G_CALLBACK(make_array), form);
	gtk_grid_set_row_spacing(GTK_GRID(grid), 6);
	gtk_grid_set_column_spacing(GTK_GRID(grid), 12);
	attach(GTK_GRID(grid), 0, _("First index"), form->low);
	attach(GTK_GRID(grid), 1, _("Last index"), form->high);
	attach(GTK_GRID(grid), 2, _("Type of the elements"), form->type);
	gtk_grid_attach(GTK_GRID(grid), form->why, 0, 3, 2, 1);
	gtk_grid_attach(GTK_GRID(grid), button, 0, 4, 2, 1);
	popover_tell(GTK_LABEL(form->why), "");
	return grid;
}

static void open_array(LadderDocument *document, LadderPanelRow *row, GtkWidget *cell)
{
	struct array_form *form = g_new0(struct array_form, 1);
	const char *type;

	*form = (struct array_form){ .cell = g_object_ref(cell), .row = g_object_ref(row),
				     .popover = gtk_popover_new() };
	type = read_array(panel_row_text(row, FIELD_TYPE), form->written);
	form->low = bound_new(form, form->written[0], _("First index"));
	form->high = bound_new(form, form->written[1], _("Last index"));
	form->type = types_new(document, row->table >
			       ladder_document_project(document)->pou_count, type);
	gtk_popover_set_child(GTK_POPOVER(form->popover), array_parts(form));
	gtk_popover_set_position(GTK_POPOVER(form->popover), GTK_POS_BOTTOM);
	g_object_set_data_full(G_OBJECT(form->popover), "form", form, array_form_free);
	g_signal_connect(form->popover, "closed", G_CALLBACK(popover_drop_later), NULL);
	popover_put(form->popover, cell);
	popover_form(form->popover, cell);
	spoken_parts(form->popover);
	gtk_popover_popup(GTK_POPOVER(form->popover));
	gtk_widget_grab_focus(form->low);
}

void type_cells_open(LadderDocument *document, LadderPanelRow *row, int field,
		     GtkWidget *cell)
{
	if (field == FIELD_TYPE)
		open_array(document, row, cell);
	else
		init_dialog_open(cell, document, row->table, panel_row_text(row, FIELD_NAME));
}
