/* SPDX-License-Identifier: MIT
 *
 * ssh_ask - the questions of ssh (password, passphrase, unknown board) come to the window.
 *
 * ssh starts the editor again as its SSH_ASKPASS (ssh_ask_main()), which passes the question
 * through a private socket to the editor that started ssh. An answer is in no argument, no
 * environment, no log and no core; it is not kept.
 */
#ifndef EDITOR_SSH_ASK_H
#define EDITOR_SSH_ASK_H

#include <glib.h>
#include <stdbool.h>

struct ssh_ask;

/** ssh_ask_new - @asks: called in the main loop for each question; @yes_no: it is to be answered
 * by "yes" or not at all. Owns: ssh_ask_free(). Fails: NULL, and @error says why. */
struct ssh_ask *ssh_ask_new(void (*asks)(gpointer data, const char *question, bool yes_no),
			    gpointer data, GError **error);
void ssh_ask_free(struct ssh_ask *ask);
/** ssh_ask_environment - that of an ssh whose questions come here. Caller: g_strfreev(). */
char **ssh_ask_environment(const struct ssh_ask *ask);
/** ssh_ask_answer - to the last question; NULL: none, ssh gives up. */
void ssh_ask_answer(struct ssh_ask *ask, const char *answer);
/** ssh_ask_is_main - whether ssh started this process to ask a question. */
bool ssh_ask_is_main(void);
/** ssh_ask_main - passes the question on and prints the answer; its exit status. */
int ssh_ask_main(int argc, char **argv);

#endif
