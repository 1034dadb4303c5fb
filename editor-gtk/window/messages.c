/* SPDX-License-Identifier: MIT
 *
 * messages - messages of the window; see messages.h.
 */
#include "editor-gtk/window/messages.h"

#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/kit/gtk48/toast.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/window/below.h"

#include <string.h>

#define TOLD 1500000 /* us for which cursor moves do not replace a message     */
#define TOLD_BY_STEP 300000 /* us from the message of a step to the end of its check */

/* ---- the status bar ---- */

/* Px for the message: what the other parts of the status bar leave. */
static int room(GtkWidget *label)
{
	GtkWidget *bin = gtk_widget_get_parent(label), *bar = gtk_widget_get_parent(bin);
	int left = gtk_widget_get_width(bar);

	for (GtkWidget *part = gtk_widget_get_first_child(bar); part;
	     part = gtk_widget_get_next_sibling(part)) {
		int natural = 0;

		if (part != bin && gtk_widget_get_visible(part))
			gtk_widget_measure(part, GTK_ORIENTATION_HORIZONTAL, -1, NULL, &natural,
					   NULL, NULL);
		if (natural)
			left -= natural + gtk_box_get_spacing(GTK_BOX(bar));
	}
	return left;
}

/* The first keys of @keys that have room, none of them cut; before the window is shown, all.
 * Caller frees. */
static char *keys_that_fit(GtkWidget *label, const char *keys)
{
	static const char between[] = " · ";
	const int most = room(label);
	PangoLayout *layout = gtk_widget_create_pango_layout(label, keys);
	char *text = g_strdup(keys), *last;
	int width;

	pango_layout_get_pixel_size(layout, &width, NULL);
	while (most > 0 && width > most && (last = g_strrstr(text, between))) {
		*last = '\0';
		pango_layout_set_text(layout, text, -1);
		pango_layout_get_pixel_size(layout, &width, NULL);
	}
	g_object_unref(layout);
	return text;
}

void messages_tell(struct messages *messages, const char *text)
{
	GtkWidget *label = GTK_WIDGET(messages->message_label);
	char *keys = NULL;

	if (!messages->core->document)
		return;
	messages->told_at = text[0] ? g_get_monotonic_time() : 0;
	messages->told_of = ladder_document_version(messages->core->document);
	if (!text[0] && messages->keys)
		keys = keys_that_fit(label, messages->keys);
	gtk_label_set_text(messages->message_label, keys ? keys : text);
	tip_set(label, keys ? messages->keys : text);
	g_free(keys);
}

void messages_untell(struct messages *messages, const char *text)
{
	if (strcmp(gtk_label_get_text(messages->message_label), text) == 0)
		messages_tell(messages, "");
}

bool messages_retell(struct messages *messages, const char *before, const char *text)
{
	if (strcmp(gtk_label_get_text(messages->message_label), before) != 0)
		return false;
	messages_tell(messages, text);
	return true;
}

bool messages_can_add(struct messages *messages)
{
	LadderDocument *document = messages->core->document;

	if (ladder_document_project(document) && ladder_document_is_whole(document))
		return true;
	messages_tell(messages, _("Nothing can be added while a text of the project cannot be "
				  "read"));
	return false;
}

void messages_keys(struct messages *messages, char *text)
{
	g_free(messages->keys);
	messages->keys = text;
	if (g_get_monotonic_time() - messages->told_at > TOLD)
		messages_tell(messages, "");
}

void messages_over(struct messages *messages)
{
	if (g_get_monotonic_time() - messages->told_at > TOLD_BY_STEP)
		messages_tell(messages, "");
}

/* Clears a message about an older version of the program, except one just given for the
 * step that made this version. */
static void checked(struct messages *messages)
{
	const guint64 version = ladder_document_version(messages->core->document);

	if (messages->told_of == version)
		return;
	messages_over(messages);
	messages->told_of = version;
}

static void bookmarks_changed(struct messages *messages)
{
	messages_tell(messages, "");
}

/* ---- what stays ---- */

void messages_toast(struct messages *messages, const char *text)
{
	toast_show(messages->toasts, text);
}

void messages_log(struct messages *messages, enum log_kind kind, const char *text)
{
	const bool is_logged = g_strcmp0(messages->failed, text) == 0;

	g_clear_pointer(&messages->failed, g_free);
	if (!is_logged)
		messages_log_at(messages, kind, 0, text);
}

void messages_log_failed(struct messages *messages, const char *text, const char *why)
{
	messages_log(messages, LOG_COMMUNICATION, text);
	messages->failed = g_strdup(why);
}

void messages_log_at(struct messages *messages, enum log_kind kind, gint64 us, const char *text)
{
	ladder_log_view_put(below_panel(messages->core->below, "log"), kind, us, text);
}

void messages_banner(struct messages *messages, enum log_kind kind, const char *text,
		     const char *button, const char *action)
{
	messages_log(messages, kind, text);
	gtk_label_set_text(messages->banner_label, text);
	gtk_widget_set_visible(GTK_WIDGET(messages->banner_button), button != NULL);
	if (button)
		gtk_button_set_label(messages->banner_button, button);
	messages->banner_action = action;
	gtk_revealer_set_reveal_child(messages->banner, TRUE);
}

void messages_warn(struct messages *messages, const char *text)
{
	messages_banner(messages, LOG_SYSTEM, text, NULL, NULL);
}

void messages_close_banner(struct messages *messages)
{
	gtk_revealer_set_reveal_child(messages->banner, FALSE);
}

bool messages_has_banner(const struct messages *messages)
{
	return gtk_revealer_get_reveal_child(messages->banner);
}

bool messages_offers(const struct messages *messages, const char *action)
{
	return messages_has_banner(messages) &&
	       g_strcmp0(messages->banner_action, action) == 0;
}

bool messages_close_offer(struct messages *messages, const char *action)
{
	if (g_strcmp0(messages->banner_action, action) != 0)
		return false;
	messages_close_banner(messages);
	messages->banner_action = NULL;
	return true;
}

static void banner_clicked(struct messages *messages)
{
	messages_close_banner(messages);
	if (messages->banner_action)
		core_do(messages->core, messages->banner_action);
}

/* ---- life ---- */

/* Another width of the status bar has room for more or fewer keys. */
static void laid_out(struct messages *messages)
{
	GtkWidget *bin = gtk_widget_get_parent(GTK_WIDGET(messages->message_label));
	const int width = gtk_widget_get_width(gtk_widget_get_parent(bin));

	if (width == messages->width)
		return;
	messages->width = width;
	if (!messages->told_at)
		messages_tell(messages, "");
}

static void realized(struct messages *messages)
{
	core_connect(messages->core, gtk_native_get_surface(GTK_NATIVE(messages->core->window)),
		     "layout", G_CALLBACK(laid_out), messages, G_CONNECT_SWAPPED);
}

void messages_init(struct messages *messages, struct core *core)
{
	messages->core = core;
	spoken_text(messages->message_label);
	core_connect(core, core->window, "realize", G_CALLBACK(realized), messages,
		     G_CONNECT_SWAPPED);
	core_connect(core, messages->banner_button, "clicked", G_CALLBACK(banner_clicked),
		     messages, G_CONNECT_SWAPPED);
	core_connect(core, messages->banner_close, "clicked",
		     G_CALLBACK(messages_close_banner), messages, G_CONNECT_SWAPPED);
	core_connect(core, core->document, "checked", G_CALLBACK(checked), messages,
		     G_CONNECT_SWAPPED);
	core_connect(core, core->document, "bookmarks-changed",
		     G_CALLBACK(bookmarks_changed), messages, G_CONNECT_SWAPPED);
}

void messages_clear(struct messages *messages)
{
	g_clear_pointer(&messages->keys, g_free);
	g_clear_pointer(&messages->failed, g_free);
}
