/* SPDX-License-Identifier: MIT
 *
 * commands - a dialog that finds a command by name, and the window of all keys.
 *
 * Both are made from the rows of verbs.def.
 */
#include "editor-gtk/window/commands.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/kit/style.h"
#include "editor-gtk/kit/verbs.h"

#include <string.h>

/* ---- finding a verb ---- */

struct commands {
	GtkWindow *window;
	GtkWidget *dialog, *search, *list, *none;
	char *filled;   /* the search text that the list was filled for        */
	unsigned with;  /* the facts that hold                                 */
};

static bool fits(enum verb verb, const char *want)
{
	const char *more = verb_found(verb);
	char *all = g_strdup_printf("%s %s %s", _(verb_group_label(verb_row(verb)->group)),
				    _(verb_row(verb)->label), more ? _(more) : "");
	char *fold = g_utf8_casefold(all, -1), *folded = g_utf8_casefold(want, -1);
	bool found = strstr(fold, folded);

	g_free(all);
	g_free(fold);
	g_free(folded);
	return found;
}

/* @why: it cannot work now; NULL: it can. */
static void row_show(GtkWidget *row, const char *why)
{
	GtkWidget *label = gtk_widget_get_first_child(
		gtk_list_box_row_get_child(GTK_LIST_BOX_ROW(row)));

	style_set(label, "dim-label", why != NULL);
	tip_set(row, why);
}

static GtkWidget *row_new(enum verb verb, const char *why)
{
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 12);
	GtkWidget *label = gtk_label_new(_(verb_row(verb)->label));
	GtkWidget *group = gtk_label_new(_(verb_group_label(verb_row(verb)->group)));
	char *keys = verb_keys_label(verb);
	GtkWidget *key = gtk_label_new(keys), *row = gtk_list_box_row_new();

	gtk_label_set_xalign(GTK_LABEL(label), 0);
	gtk_widget_set_hexpand(label, TRUE);
	gtk_widget_add_css_class(group, "dim-label");
	gtk_widget_add_css_class(key, "dim-label");
	gtk_widget_add_css_class(key, "numeric");
	gtk_box_append(GTK_BOX(box), label);
	gtk_box_append(GTK_BOX(box), group);
	gtk_box_append(GTK_BOX(box), key);
	gtk_list_box_row_set_child(GTK_LIST_BOX_ROW(row), box);
	if (why)
		row_show(row, why);
	spoken_name(row, _(verb_row(verb)->label));
	g_object_set_data(G_OBJECT(row), "verb", GINT_TO_POINTER(verb));
	g_free(keys);
	return row;
}

static void fill(struct commands *commands)
{
	const char *want = gtk_editable_get_text(GTK_EDITABLE(commands->search));
	GtkListBoxRow *row;

	while ((row = gtk_list_box_get_row_at_index(GTK_LIST_BOX(commands->list), 0)))
		gtk_list_box_remove(GTK_LIST_BOX(commands->list), GTK_WIDGET(row));
	for (int i = 0; i < VERB_COUNT; i++)
		if (i != VERB_palette && fits((enum verb)i, want))
			gtk_list_box_append(GTK_LIST_BOX(commands->list),
					    row_new((enum verb)i, verb_why_not((enum verb)i,
									commands->with)));
	row = gtk_list_box_get_row_at_index(GTK_LIST_BOX(commands->list), 0);
	gtk_widget_set_visible(commands->none, !row); /* screen readers read hidden text too */
	gtk_list_box_select_row(GTK_LIST_BOX(commands->list), row);
	g_free(commands->filled);
	commands->filled = g_strdup(want);
}

/* "search-changed" comes with a delay; Enter may come before it. */
static void fill_if_due(struct commands *commands)
{
	if (g_strcmp0(commands->filled, gtk_editable_get_text(
			      GTK_EDITABLE(commands->search))) != 0)
		fill(commands);
}

static void commands_free(gpointer pointer)
{
	g_free(((struct commands *)pointer)->filled);
	g_free(pointer);
}

static enum verb row_verb(GtkListBoxRow *row)
{
	return (enum verb)GPOINTER_TO_INT(g_object_get_data(G_OBJECT(row), "verb"));
}

/* Something began or ended while the dialog is open. */
static void facts_changed(GtkWindow *window, unsigned with, GObject *dialog)
{
	struct commands *commands = g_object_get_data(dialog, "commands");
	GtkListBoxRow *row;

	(void)window;
	commands->with = with;
	for (int i = 0; (row = gtk_list_box_get_row_at_index(GTK_LIST_BOX(commands->list), i)); i++)
		row_show(GTK_WIDGET(row), verb_why_not(row_verb(row), with));
}

static void do_row(struct commands *commands, GtkListBoxRow *row)
{
	const enum verb verb = row ? row_verb(row) : VERB_COUNT;
	const char *why = verb == VERB_COUNT ? NULL : verb_why_not(verb, commands->with);
	GtkWindow *window = commands->window;

	gtk_window_destroy(GTK_WINDOW(commands->dialog));
	if (why)
		gtk_widget_activate_action(GTK_WIDGET(window), "win.tell", "s", why);
	else if (verb != VERB_COUNT)
		gtk_widget_activate_action(GTK_WIDGET(window), verb_row(verb)->action, NULL);
}

static GtkWidget *nothing_new(void)
{
	GtkWidget *label = gtk_label_new(_("Nothing found"));

	gtk_widget_add_css_class(label, "dim-label");
	gtk_widget_set_margin_top(label, 24);
	return label;
}

static void do_selected(struct commands *commands)
{
	fill_if_due(commands);
	do_row(commands, gtk_list_box_get_selected_row(GTK_LIST_BOX(commands->list)));
}

/* The focus stays in the search entry, so the list does not scroll by itself. */
static void reveal(struct commands *commands, GtkListBoxRow *row)
{
	GtkAdjustment *down = gtk_list_box_get_adjustment(
		GTK_LIST_BOX(commands->list));
	graphene_rect_t bounds;

	if (down && gtk_widget_compute_bounds(GTK_WIDGET(row), commands->list, &bounds))
		gtk_adjustment_clamp_page(down, bounds.origin.y,
					  bounds.origin.y + bounds.size.height);
}

static gboolean key_pressed(GtkEventControllerKey *controller, guint key, guint code,
			    GdkModifierType state, struct commands *commands)
{
	GtkListBox *list = GTK_LIST_BOX(commands->list);
	GtkListBoxRow *row;
	const int by = key == GDK_KEY_Down ? 1 : key == GDK_KEY_Up ? -1 : 0;

	(void)controller;
	(void)code;
	(void)state;
	if (key == GDK_KEY_Escape) {
		gtk_window_destroy(GTK_WINDOW(commands->dialog));
		return TRUE;
	}
	if (by == 0)
		return FALSE;
	fill_if_due(commands);
	row = gtk_list_box_get_selected_row(list);
	row = gtk_list_box_get_row_at_index(list, (row ?
		gtk_list_box_row_get_index(row) : -1) + by);
	if (row) {
		gtk_list_box_select_row(list, row);
		reveal(commands, row);
	}
	return TRUE;
}

void commands_show(GtkWindow *window, unsigned with)
{
	struct commands *commands = g_new0(struct commands, 1);
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
	GtkWidget *scroller = gtk_scrolled_window_new(), *bar = gtk_header_bar_new();
	GtkEventController *keys = gtk_event_controller_key_new();

	commands->window = window;
	commands->with = with;
	commands->dialog = gtk_window_new();
	commands->search = gtk_search_entry_new();
	commands->list = gtk_list_box_new();
	commands->none = nothing_new();
	gtk_widget_add_css_class(commands->list, "commands");
	gtk_list_box_set_placeholder(GTK_LIST_BOX(commands->list), commands->none);
	gtk_header_bar_set_title_widget(GTK_HEADER_BAR(bar), commands->search);
	gtk_widget_set_hexpand(commands->search, TRUE);
	gtk_window_set_titlebar(GTK_WINDOW(commands->dialog), bar);
	gtk_window_set_title(GTK_WINDOW(commands->dialog), _("All commands"));
	gtk_window_set_default_size(GTK_WINDOW(commands->dialog), 560, 460);
	gtk_window_set_transient_for(GTK_WINDOW(commands->dialog), window);
	gtk_window_set_modal(GTK_WINDOW(commands->dialog), TRUE);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller), commands->list);
	gtk_widget_set_vexpand(scroller, TRUE);
	gtk_box_append(GTK_BOX(box), scroller);
	gtk_window_set_child(GTK_WINDOW(commands->dialog), box);
	gtk_event_controller_set_propagation_phase(keys, GTK_PHASE_CAPTURE);
	g_signal_connect(keys, "key-pressed", G_CALLBACK(key_pressed), commands);
	gtk_widget_add_controller(commands->dialog, keys);
	g_signal_connect_swapped(commands->search, "search-changed", G_CALLBACK(fill_if_due),
				 commands);
	g_signal_connect_swapped(commands->search, "activate", G_CALLBACK(do_selected),
				 commands);
	g_signal_connect_swapped(commands->list, "row-activated", G_CALLBACK(do_row),
				 commands);
	g_object_set_data_full(G_OBJECT(commands->dialog), "commands", commands, commands_free);
	g_signal_connect_object(window, "facts-changed", G_CALLBACK(facts_changed),
				commands->dialog, 0);
	fill(commands);
	gtk_window_present(GTK_WINDOW(commands->dialog));
	gtk_widget_grab_focus(commands->search);
}

/* ---- all keys ---- */

#define KEYS_HIGH 13 /* rows of a column; more do not fit a screen 768 px high */

static void append_title(GString *ui, const char *title)
{
	g_string_append_printf(ui, "<child><object class='GtkShortcutsGroup'>"
			       "<property name='title'>%s</property>", title);
}

/* Accelerators for GtkShortcutsShortcut, without those of the number pad. */
static char *keys_shown(const char *text)
{
	char **keys = g_strsplit(text, "|", -1);
	GString *out = g_string_new(keys[0]);

	for (int i = 1; keys[i]; i++)
		if (!strstr(keys[i], "KP_"))
			g_string_append_printf(out, " %s", keys[i]);
	g_strfreev(keys);
	return g_string_free(out, FALSE);
}

static void append_group(GString *ui, enum verb_group group)
{
	char *title = g_markup_escape_text(_(verb_group_label(group)), -1);
	int count = 0;

	append_title(ui, title);
	for (int i = 0; i < VERB_COUNT; i++) {
		const struct verb_row *row = verb_row((enum verb)i);
		char *all, *keys_text, *label;

		if (row->group != group || !verb_keys((enum verb)i)[0])
			continue;
		if (++count % KEYS_HIGH == 0) {
			g_string_append(ui, "</object></child>");
			append_title(ui, title);
		}
		all = keys_shown(verb_keys((enum verb)i));
		keys_text = g_markup_escape_text(all, -1);
		label = g_markup_escape_text(_(row->label), -1);
		g_string_append_printf(ui, "<child><object class='GtkShortcutsShortcut'>"
			"<property name='accelerator'>%s</property>"
			"<property name='title'>%s</property></object></child>",
			keys_text, label);
		g_free(all);
		g_free(keys_text);
		g_free(label);
	}
	g_string_append(ui, "</object></child>");
	g_free(title);
}

/* A page of the window: the groups for drawing, or all others. */
static void append_section(GString *ui, const char *name, const char *title, bool drawing)
{
	char *escaped = g_markup_escape_text(title, -1);

	g_string_append_printf(ui, "<child><object class='GtkShortcutsSection'>"
		"<property name='section-name'>%s</property>"
		"<property name='title'>%s</property>"
		"<property name='max-height'>14</property>", name, escaped);
	for (int i = 0; i < VERBS_GROUPS; i++)
		if ((i == VERBS_EDIT || i == VERBS_DRAW || i == VERBS_RUNG) == drawing)
			append_group(ui, (enum verb_group)i);
	g_string_append(ui, "</object></child>");
	g_free(escaped);
}

void keys_show(GtkWindow *window)
{
	GString *ui = g_string_new("<interface><object class='GtkShortcutsWindow' id='keys'>"
				   "<property name='modal'>1</property>");
	GtkBuilder *builder;
	GtkWindow *keys;

	append_section(ui, "drawing", _("Drawing"), true);
	append_section(ui, "window", _("Window and simulation"), false);
	g_string_append(ui, "</object></interface>");
	builder = gtk_builder_new_from_string(ui->str, -1);
	keys = GTK_WINDOW(gtk_builder_get_object(builder, "keys"));
	gtk_window_set_transient_for(keys, window);
	gtk_window_present(keys);
	g_object_unref(builder);
	g_string_free(ui, TRUE);
}
