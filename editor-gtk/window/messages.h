/* SPDX-License-Identifier: MIT
 *
 * messages - messages of the window: status bar, toast, banner, log.
 */
#ifndef EDITOR_MESSAGES_H
#define EDITOR_MESSAGES_H

#include "editor-gtk/panels/log_view.h"
#include "editor-gtk/window/core.h"

struct messages {
	struct core *core;
	AdwToastOverlay *toasts;
	GtkRevealer *banner;
	GtkLabel *banner_label, *message_label;
	GtkButton *banner_button, *banner_close;
	const char *banner_action;
	gint64 told_at;   /* us; when the message in the status bar was set      */
	guint64 told_of;  /* version of the document at that time                */
	char *failed;     /* of a service, in the log already; NULL: none        */
	char *keys;       /* shown while there is no message                     */
	int width;        /* px of the status bar, when keys were shown last     */
};

void messages_init(struct messages *messages, struct core *core);
void messages_clear(struct messages *messages);
/** messages_tell - shows a short message in the status bar, for a moment at least; "":
 * none. */
void messages_tell(struct messages *messages, const char *text);
/** messages_untell - clears the status bar if it still says @text. */
void messages_untell(struct messages *messages, const char *text);
/** messages_retell - shows @text if the status bar still says @before. False: it says something else. */
bool messages_retell(struct messages *messages, const char *before, const char *text);
/** messages_over - clears the status bar: what it says is over. A message that was just given stays; it is about what
 * happens now. */
void messages_over(struct messages *messages);
/** messages_can_add - can a declaration be added now? If not, it tells why. */
bool messages_can_add(struct messages *messages);
/** messages_keys - what the next key would do (taken over), shown while there is no
 * message. */
void messages_keys(struct messages *messages, char *text);
/** messages_toast - a message that disappears by itself. */
void messages_toast(struct messages *messages, const char *text);
/** messages_log - adds a line to the log (ladder_log_view_put()). */
void messages_log(struct messages *messages, enum log_kind kind, const char *text);
/** messages_log_at - of something that happened at @us, as g_get_real_time(). */
void messages_log_at(struct messages *messages, enum log_kind kind, gint64 us, const char *text);
/** messages_log_failed - adds the line @text of a service that failed, because of @why. If @why is
 * told next, by messages_banner() or messages_log(), it is not logged again. */
void messages_log_failed(struct messages *messages, const char *text, const char *why);
/** messages_banner - a message that stays until it is closed, and is logged. @button, @action: a button and the action of the window
 * it activates; static, or both NULL. */
void messages_banner(struct messages *messages, enum log_kind kind, const char *text,
		     const char *button, const char *action);
/** messages_warn - a banner without a button. */
void messages_warn(struct messages *messages, const char *text);
void messages_close_banner(struct messages *messages);
/** messages_has_banner - is a banner open? */
bool messages_has_banner(const struct messages *messages);
/** messages_offers - is a banner open whose button has @action? */
bool messages_offers(const struct messages *messages, const char *action);
/** messages_close_offer - closes the banner if its button has @action. False: it has
 * another. */
bool messages_close_offer(struct messages *messages, const char *action);

#endif
