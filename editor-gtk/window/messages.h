/* SPDX-License-Identifier: MIT
 *
 * messages - what the window says: in the status bar, in a toast, in a banner, in the log.
 */
#ifndef EDITOR_MESSAGES_H
#define EDITOR_MESSAGES_H

#include "editor-gtk/window/core.h"

struct messages {
	struct core *core;
	AdwToastOverlay *toasts;
	GtkRevealer *banner;
	GtkLabel *banner_label, *message_label;
	GtkButton *banner_button, *banner_close;
	const char *banner_action;
	gint64 told_at;   /* us; when the message in the status bar came         */
	guint64 told_of;  /* version of the document then                        */
	char *keys;       /* stands in the status bar when there is no message   */
};

void messages_init(struct messages *messages, struct core *core);
void messages_clear(struct messages *messages);
/** messages_tell - a short message in the status bar; "" for none. It stays for a moment
 * while the cursor moves. */
void messages_tell(struct messages *messages, const char *text);
/** messages_keys - what the next key could do (taken over), shown where no message stands. */
void messages_keys(struct messages *messages, char *text);
/** messages_toast - a message that goes by itself. */
void messages_toast(struct messages *messages, const char *text);
/** messages_log - a line of the log (ladder_log_view_put). */
void messages_log(struct messages *messages, const char *kind, const char *text);
/** messages_banner - a message that stays until it is closed. @action: of the window, what
 * the button @button does; lives for ever. Both NULL: no button. The log keeps the message,
 * as one of @kind, translated; NULL: of the system. */
void messages_banner(struct messages *messages, const char *kind, const char *text,
		     const char *button, const char *action);
/** messages_warn - a banner without a button. */
void messages_warn(struct messages *messages, const char *text);
void messages_close_banner(struct messages *messages);
/** messages_has_banner - is any banner seen? */
bool messages_has_banner(const struct messages *messages);
/** messages_close_offer - closes the banner if its button does @action. Returns false if it
 * does something else. */
bool messages_close_offer(struct messages *messages, const char *action);

#endif
