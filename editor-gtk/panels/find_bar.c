/* SPDX-License-Identifier: MIT
 *
 * find_bar - the bar that finds and replaces; see find_bar.h.
 */
#include "editor-gtk/panels/find_bar.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/document/panel.h"
#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/kit/style.h"

#include <string.h>

enum { HITS_CHANGED, CLOSED, SIGNALS };

struct _LadderFindBar {
	GtkWidget parent_instance;
	GtkWidget *revealer, *entry, *with, *second, *where, *match_case, *whole_word;
	GtkWidget *message;
	struct panel_watch *watch;
	struct find *find;
	int current;            /* index of the current hit; -1: none          */
	int place[4];           /* cursor: POU, rung, row, column              */
};

G_DEFINE_FINAL_TYPE(LadderFindBar, ladder_find_bar, GTK_TYPE_WIDGET)

static guint signals[SIGNALS];

/* In the order of the drop-down. */
static const unsigned int places[] = {
	FIND_EVERYWHERE, FIND_OPERANDS, FIND_COMMENTS | FIND_TITLES, FIND_LABELS,
	FIND_LISTS, FIND_DECLARATIONS,
};

/* ---- hits ---- */

static struct find_options options_of(LadderFindBar *bar)
{
	guint where = gtk_drop_down_get_selected(GTK_DROP_DOWN(bar->where));

	return (struct find_options){
		.where = places[where < G_N_ELEMENTS(places) ? where : 0],
		.match_case = gtk_toggle_button_get_active(
			GTK_TOGGLE_BUTTON(bar->match_case)),
		.whole_word = gtk_toggle_button_get_active(
			GTK_TOGGLE_BUTTON(bar->whole_word)),
	};
}

static void set_message(LadderFindBar *bar, const char *text, bool error)
{
	gtk_label_set_text(GTK_LABEL(bar->message), text);
	tip_set(bar->message, text);
	style_set(bar->message, "error", error);
}

static void show_count(LadderFindBar *bar)
{
	const guint count = bar->find ? bar->find->hit->len : 0;
	char *text;

	if (!*gtk_editable_get_text(GTK_EDITABLE(bar->entry)))
		text = g_strdup("");
	else if (!count)
		text = g_strdup(_("Nothing found"));
	else if (bar->current < 0)
		text = g_strdup_printf(ngettext("%u hit", "%u hits", count), count);
	else
		text = g_strdup_printf(_("%d of %u"), bar->current + 1, count);
	set_message(bar, text, false);
	g_free(text);
	gtk_widget_action_set_enabled(GTK_WIDGET(bar), "find.next", count);
	gtk_widget_action_set_enabled(GTK_WIDGET(bar), "find.previous", count);
	gtk_widget_action_set_enabled(GTK_WIDGET(bar), "find.replace", count);
	gtk_widget_action_set_enabled(GTK_WIDGET(bar), "find.replace-all", count);
}

static void search(LadderFindBar *bar, bool now)
{
	LadderDocument *document = panel_watch_document(bar->watch);
	const char *text = gtk_editable_get_text(GTK_EDITABLE(bar->entry));

	g_clear_pointer(&bar->find, find_free);
	bar->current = -1;
	if (document && *text && now)
		bar->find = find_new(document, text, options_of(bar));
	show_count(bar);
	g_signal_emit(bar, signals[HITS_CHANGED], 0);
}

static void look(GtkWidget *widget)
{
	LadderFindBar *bar = LADDER_FIND_BAR(widget);

	search(bar, ladder_find_bar_is_open(bar));
}

/* The widget in the bar that has the focus; NULL: none. */
static GtkWidget *keys_inside(LadderFindBar *bar)
{
	GtkRoot *root = gtk_widget_get_root(GTK_WIDGET(bar));
	GtkWidget *focus = root ? gtk_root_get_focus(root) : NULL;

	return focus && gtk_widget_is_ancestor(focus, GTK_WIDGET(bar)) ? focus : NULL;
}

/* Keeps the focus in the bar: another Return goes to the next hit, and must not edit the
 * sheet. */
static void keep_keys(GtkWidget *inside)
{
	if (GTK_IS_TEXT(inside))
		gtk_text_grab_focus_without_selecting(GTK_TEXT(inside));
	else if (inside)
		gtk_widget_grab_focus(inside);
}

static void go(LadderFindBar *bar, int number)
{
	const struct find_hit *hit = bar->find->hit->pdata[number];
	GtkWidget *inside = keys_inside(bar);

	bar->current = number;
	show_count(bar);
	ladder_find_bar_set_place(bar, hit->pou, hit->rung, hit->row, hit->col);
	if (hit->where == FIND_DECLARATIONS)
		gtk_widget_activate_action(GTK_WIDGET(bar), "win.go-to", "(iiii)", -1, -1,
					   hit->table, hit->index);
	else
		gtk_widget_activate_action(GTK_WIDGET(bar), "win.go-to", "(iiii)", hit->pou,
					   hit->rung, hit->row, hit->col);
	keep_keys(inside);
	g_signal_emit(bar, signals[HITS_CHANGED], 0); /* another hit is current */
}

bool ladder_find_bar_next(LadderFindBar *bar, bool back)
{
	int count, number;

	if (!ladder_find_bar_is_open(bar))
		search(bar, true); /* the text of the last search */
	count = bar->find ? (int)bar->find->hit->len : 0;
	if (!count)
		return false;
	/* Several hits may be at one place. */
	if (bar->current >= 0)
		number = (bar->current + (back ? count - 1 : 1)) % count;
	else
		number = find_next(bar->find, bar->place[0], bar->place[1], bar->place[2],
				   bar->place[3], back);
	go(bar, number);
	return true;
}

const struct find *ladder_find_bar_find(LadderFindBar *bar)
{
	return bar->find;
}

int ladder_find_bar_current(LadderFindBar *bar)
{
	return bar->current;
}

const int *ladder_find_bar_place(LadderFindBar *bar)
{
	return bar->place;
}

void ladder_find_bar_set_place(LadderFindBar *bar, int pou, int rung, int row, int col)
{
	const int place[] = { pou, rung, row, col };
	const struct find_hit *hit = bar->current >= 0 ?
		bar->find->hit->pdata[bar->current] : NULL;

	memcpy(bar->place, place, sizeof(place));
	/* After a cursor move, the search continues from there. */
	if (hit && (hit->pou != pou || hit->rung != rung || hit->row != row ||
		    hit->col != col))
		bar->current = -1;
}

/* ---- replacing ---- */

static void next(GtkWidget *widget, const char *action, GVariant *unused)
{
	(void)unused;
	ladder_find_bar_next(LADDER_FIND_BAR(widget), strcmp(action, "find.previous") == 0);
}

/* Has the current hit text that can be replaced? */
static bool is_on_text(LadderFindBar *bar)
{
	const struct find_hit *hit = bar->current < 0 ? NULL :
		bar->find->hit->pdata[bar->current];

	return hit && !hit->by_symbol;
}

/* Replaces the current hit; without one, only goes to the next. */
static void replace(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderFindBar *bar = LADDER_FIND_BAR(widget);
	const int number = bar->current;
	char *why = NULL;

	(void)action;
	(void)unused;
	panel_watch_now(bar->watch);
	if (bar->current != number || !is_on_text(bar)) {
		ladder_find_bar_next(bar, false);
		return;
	}
	if (!find_replace(panel_watch_document(bar->watch), bar->find, number,
			  gtk_editable_get_text(GTK_EDITABLE(bar->with)), &why)) {
		panel_watch_now(bar->watch); /* sets its message before the reason */
		set_message(bar, why ? why : _("Refused"), true);
		g_free(why);
		return;
	}
	panel_watch_now(bar->watch);
	if (bar->find && bar->find->hit->len)
		go(bar, MIN(number, (int)bar->find->hit->len - 1));
}

static void replace_all(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderFindBar *bar = LADDER_FIND_BAR(widget);
	char *why = NULL, *text;
	int count;

	(void)action;
	(void)unused;
	panel_watch_now(bar->watch);
	if (!bar->find || !bar->find->hit->len)
		return;
	count = find_replace_all(panel_watch_document(bar->watch), bar->find,
				 gtk_editable_get_text(GTK_EDITABLE(bar->with)), &why);
	panel_watch_now(bar->watch); /* also after a refusal: some may be replaced */
	text = count < 0 ? g_strdup(why ? why : _("Refused")) :
	       g_strdup_printf(ngettext("%d replaced", "%d replaced", (gulong)count), count);
	set_message(bar, text, count < 0);
	g_free(text);
	g_free(why);
}

/* ---- open and closed ---- */

bool ladder_find_bar_has_keys(LadderFindBar *bar)
{
	return keys_inside(bar) != NULL;
}

bool ladder_find_bar_is_open(LadderFindBar *bar)
{
	return gtk_revealer_get_reveal_child(GTK_REVEALER(bar->revealer));
}

void ladder_find_bar_open(LadderFindBar *bar, bool with, const char *text)
{
	gtk_widget_set_visible(bar->second, with);
	gtk_revealer_set_reveal_child(GTK_REVEALER(bar->revealer), TRUE);
	if (text)
		gtk_editable_set_text(GTK_EDITABLE(bar->entry), text);
	look(GTK_WIDGET(bar));
	gtk_widget_grab_focus(bar->entry);
	gtk_editable_select_region(GTK_EDITABLE(bar->entry), 0, -1);
}

void ladder_find_bar_close(LadderFindBar *bar)
{
	if (!ladder_find_bar_is_open(bar))
		return;
	gtk_revealer_set_reveal_child(GTK_REVEALER(bar->revealer), FALSE);
	g_signal_emit(bar, signals[CLOSED], 0);
	look(GTK_WIDGET(bar));
}

static void close_bar(GtkWidget *widget, const char *action, GVariant *unused)
{
	(void)action;
	(void)unused;
	ladder_find_bar_close(LADDER_FIND_BAR(widget));
}

/* ---- what a person does ---- */

static void asked(LadderFindBar *bar)
{
	if (bar->watch)
		look(GTK_WIDGET(bar));
}

static void option_changed(GObject *option, GParamSpec *spec, LadderFindBar *bar)
{
	(void)option;
	(void)spec;
	asked(bar);
}

static void text_changed(GtkEditable *entry, LadderFindBar *bar)
{
	(void)entry;
	asked(bar);
}

static void entered(GtkEntry *entry, LadderFindBar *bar)
{
	(void)entry;
	ladder_find_bar_next(bar, false);
}

static void with_entered(GtkEntry *entry, LadderFindBar *bar)
{
	(void)entry;
	gtk_widget_activate_action(GTK_WIDGET(bar), "find.replace", NULL);
}

/* ---- the widget ---- */

void ladder_find_bar_set_document(LadderFindBar *bar, LadderDocument *document)
{
	if (!panel_watch_set(bar->watch, document))
		return;
	look(GTK_WIDGET(bar));
}

static void dispose(GObject *object)
{
	LadderFindBar *bar = LADDER_FIND_BAR(object);

	g_clear_pointer(&bar->watch, panel_watch_free);
	g_clear_pointer(&bar->revealer, gtk_widget_unparent);
	g_clear_pointer(&bar->find, find_free);
	G_OBJECT_CLASS(ladder_find_bar_parent_class)->dispose(object);
}

static void bind_children(GtkWidgetClass *class)
{
	gtk_widget_class_set_layout_manager_type(class, GTK_TYPE_BIN_LAYOUT);
	gtk_widget_class_set_template_from_resource(class,
		"/org/rungboard/Editor/ui/find_bar.ui");
	gtk_widget_class_bind_template_child(class, LadderFindBar, revealer);
	gtk_widget_class_bind_template_child(class, LadderFindBar, entry);
	gtk_widget_class_bind_template_child(class, LadderFindBar, with);
	gtk_widget_class_bind_template_child(class, LadderFindBar, second);
	gtk_widget_class_bind_template_child(class, LadderFindBar, where);
	gtk_widget_class_bind_template_child(class, LadderFindBar, match_case);
	gtk_widget_class_bind_template_child(class, LadderFindBar, whole_word);
	gtk_widget_class_bind_template_child(class, LadderFindBar, message);
	gtk_widget_class_bind_template_callback(class, option_changed);
	gtk_widget_class_bind_template_callback(class, text_changed);
	gtk_widget_class_bind_template_callback(class, entered);
	gtk_widget_class_bind_template_callback(class, with_entered);
}

static void ladder_find_bar_class_init(LadderFindBarClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = dispose;
	signals[HITS_CHANGED] = g_signal_new("hits-changed", LADDER_TYPE_FIND_BAR,
		G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL, G_TYPE_NONE, 0);
	signals[CLOSED] = g_signal_new("closed", LADDER_TYPE_FIND_BAR, G_SIGNAL_RUN_LAST, 0,
		NULL, NULL, NULL, G_TYPE_NONE, 0);
	gtk_widget_class_install_action(widget, "find.next", NULL, next);
	gtk_widget_class_install_action(widget, "find.previous", NULL, next);
	gtk_widget_class_install_action(widget, "find.replace", NULL, replace);
	gtk_widget_class_install_action(widget, "find.replace-all", NULL, replace_all);
	gtk_widget_class_install_action(widget, "find.close", NULL, close_bar);
	gtk_widget_class_add_binding_action(widget, GDK_KEY_Escape, 0, "find.close", NULL);
	gtk_widget_class_add_binding_action(widget, GDK_KEY_F3, 0, "find.next", NULL);
	gtk_widget_class_add_binding_action(widget, GDK_KEY_F3, GDK_SHIFT_MASK,
					    "find.previous", NULL);
	gtk_widget_class_add_binding_action(widget, GDK_KEY_Return, GDK_SHIFT_MASK,
					    "find.previous", NULL);
	gtk_widget_class_add_binding_action(widget, GDK_KEY_KP_Enter, GDK_SHIFT_MASK,
					    "find.previous", NULL);
	bind_children(widget);
}

static void ladder_find_bar_init(LadderFindBar *bar)
{
	bar->current = -1;
	bar->place[0] = bar->place[1] = bar->place[2] = bar->place[3] = -1;
	gtk_widget_init_template(GTK_WIDGET(bar));
	bar->watch = panel_watch_new(GTK_WIDGET(bar), false, look);
	show_count(bar);
}

GtkWidget *ladder_find_bar_new(void)
{
	return g_object_new(LADDER_TYPE_FIND_BAR, NULL);
}
