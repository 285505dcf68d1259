/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * How a test on the host and a program of an SPU work together. The program holds a list of functions, each of which
 * transforms a record in place; the host fills an area of local store with records and asks for one function on all.
 *
 *   outbound mailbox   at its start the program writes the area's address
 *   inbound mailbox    then it reads a number of a function, EXCHANGE_END to end, and a count of records
 *
 * The host sees that the work is done when the program reads the next number. */
#ifndef EXCHANGE_H
#define EXCHANGE_H

#define EXCHANGE_QUADS 2048 /* of the area: 32 KB */
#define EXCHANGE_END 0xffffffffu

/* Channels of the mailboxes, as the hardware numbers them. */
#define EXCHANGE_OUTBOUND 28
#define EXCHANGE_INBOUND 29

#endif
