/* SPDX-License-Identifier: MIT
 *
 * grid_view_keys - keys that a sheet hears: its cursor's, letters that begin an entry, and
 * what input methods compose of them.
 *
 * Keys of verbs come first (verbs.h), but for those with which somebody composes: a blank
 * chooses a Chinese name, and must not be a verb then. What is composed so far is shown at
 * the cursor; what comes of it begins the entry.
 */
#include "editor-gtk/ladder/grid_view_inside.h"

#include <string.h>

#define PAD 4 /* px round what is composed                                     */

/* ---- input methods ---- */

/* They have the first look at a key: what they make of it, if that is not just the key
 * itself, is what the person typed. */
static bool is_composed(LadderGridView *view, GtkEventControllerKey *controller,
			gunichar key)
{
	GdkEvent *event = gtk_event_controller_get_current_event(
		GTK_EVENT_CONTROLLER(controller));

	view->key = key;
	view->plain = false;
	return gtk_im_context_filter_keypress(view->input, event) && !view->plain;
}

/* While something is composed every key belongs to that. */
static gboolean key_captured(GtkEventControllerKey *controller, guint key, guint code,
			     GdkModifierType state, LadderGridView *view)
{
	(void)code;
	(void)state;
	return view->composed && !view->entry &&
	       is_composed(view, controller, gdk_keyval_to_unicode(key));
}

static void show_composed(LadderGridView *view)
{
	char *text = NULL;

	gtk_im_context_get_preedit_string(view->input, &text, NULL, NULL);
	g_clear_pointer(&view->composed, g_free);
	if (text && text[0])
		view->composed = g_steal_pointer(&text);
	g_free(text);
	gtk_widget_queue_draw(GTK_WIDGET(view));
}

/* Chinese names, letters with accents: what is no key. */
static void key_composed(GtkIMContext *input, const char *text, LadderGridView *view)
{
	(void)input;
	if (text[0] && g_utf8_get_char(text) == view->key && !*g_utf8_next_char(text))
		view->plain = true;
	else if (!view->entry)
		entry_begin(view, text);
}

static void focus_changed(LadderGridView *view)
{
	if (gtk_widget_has_focus(GTK_WIDGET(view))) {
		gtk_im_context_focus_in(view->input);
		keys_moved(view);
		return;
	}
	gtk_im_context_reset(view->input);
	gtk_im_context_focus_out(view->input);
	show_composed(view);
}

/* Their candidates are shown beside the cell. */
void keys_moved(LadderGridView *view)
{
	graphene_rect_t rect;

	if (!view->input || !gtk_widget_has_focus(GTK_WIDGET(view)))
		return;
	rect = cursor_rect(view);
	gtk_im_context_set_cursor_location(view->input, &(GdkRectangle){
		(int)rect.origin.x, (int)rect.origin.y, (int)rect.size.width,
		(int)rect.size.height });
}

void keys_snapshot(LadderGridView *view, GtkSnapshot *snapshot, const struct theme *theme)
{
	const graphene_rect_t cell = cursor_rect(view);
	PangoLayout *layout;
	int width, height;
	float x, y;

	if (!view->composed)
		return;
	layout = gtk_widget_create_pango_layout(GTK_WIDGET(view), view->composed);
	pango_layout_get_pixel_size(layout, &width, &height);
	x = cell.origin.x + PAD;
	y = cell.origin.y + PAD;
	gtk_snapshot_append_color(snapshot, &theme->color[TOKEN_SHEET],
		&GRAPHENE_RECT_INIT(x, y, (float)width + 2 * PAD, (float)height + 2 * PAD));
	gtk_snapshot_append_color(snapshot, &theme->color[TOKEN_ACCENT],
		&GRAPHENE_RECT_INIT(x, y + (float)height + 2 * PAD - 2,
				    (float)width + 2 * PAD, 2));
	gtk_snapshot_save(snapshot);
	gtk_snapshot_translate(snapshot, &GRAPHENE_POINT_INIT(x + PAD, y + PAD));
	gtk_snapshot_append_layout(snapshot, layout, &theme->color[TOKEN_INK]);
	gtk_snapshot_restore(snapshot);
	g_object_unref(layout);
}

/* ---- keys ---- */

static void key_released(GtkEventControllerKey *controller, guint key, guint code,
			 GdkModifierType state, LadderGridView *view)
{
	(void)key;
	(void)code;
	(void)state;
	gtk_im_context_filter_keypress(view->input, gtk_event_controller_get_current_event(
		GTK_EVENT_CONTROLLER(controller)));
}

/* Names, addresses, expressions; `= Motor`, `!Stop`, `-(S)- Lamp`. A slash is a verb's. */
static bool begins_entry(gunichar c)
{
	return g_unichar_isalpha(c) || (c > 0 && c < 128 && strchr("%[_=!(-|", (int)c));
}

static gboolean key_pressed(GtkEventControllerKey *controller, guint key, guint code,
			    GdkModifierType state, LadderGridView *view)
{
	const GdkModifierType others = GDK_CONTROL_MASK | GDK_ALT_MASK | GDK_SUPER_MASK;
	gunichar c = gdk_keyval_to_unicode(key);
	char text[8] = "";

	(void)code;
	if (cursor_key(view, key, state) || is_composed(view, controller, c))
		return TRUE;
	if (state & others || !begins_entry(c))
		return FALSE;
	text[g_unichar_to_utf8(c, text)] = '\0';
	entry_begin(view, text);
	return TRUE;
}

void keys_init(LadderGridView *view)
{
	GtkEventController *captured = gtk_event_controller_key_new();
	GtkEventController *keys = gtk_event_controller_key_new();

	view->input = gtk_im_multicontext_new();
	gtk_im_context_set_client_widget(view->input, GTK_WIDGET(view));
	gtk_event_controller_set_propagation_phase(captured, GTK_PHASE_CAPTURE);
	g_signal_connect(captured, "key-pressed", G_CALLBACK(key_captured), view);
	g_signal_connect(keys, "key-pressed", G_CALLBACK(key_pressed), view);
	g_signal_connect(keys, "key-released", G_CALLBACK(key_released), view);
	g_signal_connect(view->input, "commit", G_CALLBACK(key_composed), view);
	g_signal_connect_swapped(view->input, "preedit-changed", G_CALLBACK(show_composed),
				 view);
	g_signal_connect(view, "notify::has-focus", G_CALLBACK(focus_changed), NULL);
	gtk_widget_add_controller(GTK_WIDGET(view), captured);
	gtk_widget_add_controller(GTK_WIDGET(view), keys);
	/* Those of verbs come before the letters that begin an entry. */
	gtk_widget_add_controller(GTK_WIDGET(view), verbs_controller(VERB_SHEET));
}
