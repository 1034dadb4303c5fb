/* SPDX-License-Identifier: MIT
 *
 * form - a dialog of rows; see form.h.
 */
#include "editor-gtk/window/form.h"

#include "editor-gtk/kit/cells.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/i18n.h"

#define ENTRY_WIDE 30 /* characters                                           */

struct form {
	GtkWidget *window, *page, *apply_button, *why;
	AdwPreferencesGroup *group;
	GPtrArray *row;          /* of GtkEntry or GtkTextView                  */
	int judged;              /* its row; -1: none                           */
	char *(*refusal)(const char *text, gpointer data);
	char *(*apply)(struct form *form, gpointer data);
	gpointer data;
	GDestroyNotify free;
};

static void form_free(gpointer pointer)
{
	struct form *form = pointer;

	if (form->free)
		form->free(form->data);
	g_ptr_array_unref(form->row);
	g_free(form);
}

static void refuse(struct form *form, char *why)
{
	gtk_label_set_text(GTK_LABEL(form->why), why ? why : "");
	gtk_widget_set_visible(form->why, why != NULL);
	g_free(why);
}

static void apply(struct form *form)
{
	char *why;

	if (!gtk_widget_get_sensitive(form->apply_button))
		return;
	why = form->apply(form, form->data);
	if (why)
		refuse(form, why);
	else
		gtk_window_destroy(GTK_WINDOW(form->window));
}

static void judge(struct form *form)
{
	GtkWidget *row = form->row->pdata[form->judged];
	char *text = form_get(form, form->judged);
	char *why = form->refusal(text, form->data);

	gtk_widget_set_sensitive(form->apply_button, !why);
	refuse(form, g_strdup(why));
	cells_refuse(row, why);
	g_free(text);
}

void form_judge(struct form *form, int row, char *(*refusal)(const char *text, gpointer data))
{
	form->judged = row;
	form->refusal = refusal;
	g_signal_connect_swapped(form->row->pdata[row], "changed", G_CALLBACK(judge), form);
}

void form_group(struct form *form, const char *title)
{
	form->group = ADW_PREFERENCES_GROUP(adw_preferences_group_new());
	if (title)
		adw_preferences_group_set_title(form->group, title);
	adw_preferences_page_add(ADW_PREFERENCES_PAGE(form->page), form->group);
}

int form_entry(struct form *form, const char *title, const char *text)
{
	GtkWidget *row = adw_action_row_new(), *entry = gtk_entry_new();

	adw_preferences_row_set_title(ADW_PREFERENCES_ROW(row), title);
	gtk_editable_set_text(GTK_EDITABLE(entry), text);
	gtk_widget_set_valign(entry, GTK_ALIGN_CENTER);
	/* With large letters the entry gives way, not the title. */
	gtk_editable_set_width_chars(GTK_EDITABLE(entry), ENTRY_WIDE / 3);
	gtk_editable_set_max_width_chars(GTK_EDITABLE(entry), ENTRY_WIDE);
	spoken_name(entry, title);
	g_signal_connect_swapped(entry, "activate", G_CALLBACK(apply), form);
	adw_action_row_add_suffix(ADW_ACTION_ROW(row), entry);
	gtk_widget_set_focusable(row, FALSE);
	adw_preferences_group_add(form->group, row);
	g_ptr_array_add(form->row, entry);
	return (int)form->row->len - 1;
}

int form_text(struct form *form, const char *title, const char *text)
{
	GtkWidget *view = gtk_text_view_new(), *scroller = gtk_scrolled_window_new();
	GtkWidget *row = adw_preferences_row_new(), *label = gtk_label_new(title);
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 4);

	gtk_label_set_xalign(GTK_LABEL(label), 0);
	gtk_widget_add_css_class(label, "caption");
	gtk_widget_add_css_class(label, "dim-label");
	gtk_text_buffer_set_text(gtk_text_view_get_buffer(GTK_TEXT_VIEW(view)), text, -1);
	gtk_text_view_set_wrap_mode(GTK_TEXT_VIEW(view), GTK_WRAP_WORD_CHAR);
	gtk_text_view_set_accepts_tab(GTK_TEXT_VIEW(view), FALSE);
	gtk_widget_add_css_class(view, "form-text");
	spoken_name(view, title);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller), view);
	gtk_scrolled_window_set_min_content_height(GTK_SCROLLED_WINDOW(scroller), 72);
	gtk_widget_set_margin_start(box, 12);
	gtk_widget_set_margin_end(box, 12);
	gtk_widget_set_margin_top(box, 8);
	gtk_widget_set_margin_bottom(box, 8);
	gtk_box_append(GTK_BOX(box), label);
	gtk_box_append(GTK_BOX(box), scroller);
	gtk_list_box_row_set_child(GTK_LIST_BOX_ROW(row), box);
	gtk_list_box_row_set_activatable(GTK_LIST_BOX_ROW(row), FALSE);
	gtk_widget_set_focusable(row, FALSE);
	adw_preferences_row_set_title(ADW_PREFERENCES_ROW(row), title);
	adw_preferences_group_add(form->group, row);
	g_ptr_array_add(form->row, view);
	return (int)form->row->len - 1;
}

void form_fact(struct form *form, const char *title, char *text)
{
	GtkWidget *row;

	if (!text)
		return;
	row = adw_action_row_new();
	adw_preferences_row_set_use_markup(ADW_PREFERENCES_ROW(row), FALSE);
	adw_preferences_row_set_title(ADW_PREFERENCES_ROW(row), title);
	adw_action_row_set_subtitle(ADW_ACTION_ROW(row), text);
	adw_preferences_group_add(form->group, row);
	g_free(text);
}

char *form_get(const struct form *form, int row)
{
	GtkWidget *widget = form->row->pdata[row];
	GtkTextBuffer *buffer;
	GtkTextIter start, end;

	if (!GTK_IS_TEXT_VIEW(widget))
		return g_strstrip(g_strdup(gtk_editable_get_text(GTK_EDITABLE(widget))));
	buffer = gtk_text_view_get_buffer(GTK_TEXT_VIEW(widget));
	gtk_text_buffer_get_bounds(buffer, &start, &end);
	return g_strstrip(gtk_text_buffer_get_text(buffer, &start, &end, FALSE));
}

static gboolean key_pressed(GtkWindow *window, guint key)
{
	if (key != GDK_KEY_Escape)
		return FALSE;
	gtk_window_close(window);
	return TRUE;
}

static GtkWidget *header_new(struct form *form)
{
	GtkWidget *header = adw_header_bar_new();
	GtkWidget *cancel = gtk_button_new_with_label(_("Cancel"));

	form->apply_button = gtk_button_new_with_label(_("Apply"));
	gtk_widget_add_css_class(form->apply_button, "suggested-action");
	adw_header_bar_set_show_end_title_buttons(ADW_HEADER_BAR(header), FALSE);
	adw_header_bar_set_show_start_title_buttons(ADW_HEADER_BAR(header), FALSE);
	adw_header_bar_pack_start(ADW_HEADER_BAR(header), cancel);
	adw_header_bar_pack_end(ADW_HEADER_BAR(header), form->apply_button);
	g_signal_connect_swapped(cancel, "clicked", G_CALLBACK(gtk_window_close), form->window);
	g_signal_connect_swapped(form->apply_button, "clicked", G_CALLBACK(apply), form);
	return header;
}

struct form *form_new(GtkWindow *window, const char *title,
		      char *(*apply_form)(struct form *form, gpointer data), gpointer data,
		      GDestroyNotify free)
{
	struct form *form = g_new0(struct form, 1);
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
	GtkEventController *keys = gtk_event_controller_key_new();

	*form = (struct form){ .window = adw_window_new(), .page = adw_preferences_page_new(),
		.why = gtk_label_new(""), .row = g_ptr_array_new(), .judged = -1,
		.apply = apply_form, .data = data, .free = free };
	gtk_window_set_title(GTK_WINDOW(form->window), title);
	gtk_window_set_transient_for(GTK_WINDOW(form->window), window);
	gtk_window_set_modal(GTK_WINDOW(form->window), TRUE);
	gtk_window_set_destroy_with_parent(GTK_WINDOW(form->window), TRUE);
	gtk_label_set_wrap(GTK_LABEL(form->why), TRUE);
	gtk_widget_add_css_class(form->why, "error");
	gtk_widget_set_visible(form->why, FALSE);
	gtk_widget_set_margin_start(form->why, 18);
	gtk_widget_set_margin_end(form->why, 18);
	gtk_widget_set_margin_top(form->why, 6);
	gtk_box_append(GTK_BOX(box), header_new(form));
	gtk_box_append(GTK_BOX(box), form->why);
	gtk_widget_set_vexpand(form->page, TRUE);
	gtk_box_append(GTK_BOX(box), form->page);
	adw_window_set_content(ADW_WINDOW(form->window), box);
	g_signal_connect_swapped(keys, "key-pressed", G_CALLBACK(key_pressed), form->window);
	gtk_widget_add_controller(form->window, keys);
	g_object_set_data_full(G_OBJECT(form->window), "form", form, form_free);
	form_group(form, NULL);
	return form;
}

/* How much larger than usual a person's letters are. */
static double letter_scale(void)
{
	int dpi = 0;

	g_object_get(gtk_settings_get_default(), "gtk-xft-dpi", &dpi, NULL);
	return MAX(dpi / (96.0 * PANGO_SCALE), 1);
}

void form_show(struct form *form)
{
	gtk_window_set_default_size(GTK_WINDOW(form->window), (int)(520 * letter_scale()), 640);
	gtk_window_present(GTK_WINDOW(form->window));
	if (form->row->len)
		gtk_widget_grab_focus(form->row->pdata[0]);
}
