/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Loads and stores of quadwords, whose addresses wrap around and lose their low four bits; hints, which change time
 * alone. A part of rows.h. */
/* clang-format off */
CGT_SPU_ROW(lqd,  RI10Q, 0x1a0, LS, T_OF_A,    LOAD(ra->word[0] + (uint32_t)imm))
CGT_SPU_ROW(lqx,  RR,    0x1c4, LS, T_OF_AB,   LOAD(ra->word[0] + rb->word[0]))
CGT_SPU_ROW(lqa,  RI16W, 0x184, LS, T_OF_NONE, LOAD((uint32_t)imm))
CGT_SPU_ROW(lqr,  RI16W, 0x19c, LS, T_OF_NONE, LOAD(pc + (uint32_t)imm))
CGT_SPU_ROW(stqd, RI10Q, 0x120, LS, ONLY_AT,   STORE(ra->word[0] + (uint32_t)imm))
CGT_SPU_ROW(stqx, RR,    0x144, LS, ONLY_ABT,  STORE(ra->word[0] + rb->word[0]))
CGT_SPU_ROW(stqa, RI16W, 0x104, LS, ONLY_T,    STORE((uint32_t)imm))
CGT_SPU_ROW(stqr, RI16W, 0x11c, LS, ONLY_T,    STORE(pc + (uint32_t)imm))
CGT_SPU_ROW(hbr,  LBTI,  0x1ac, LS, ONLY_A,    HINT(ra->word[0], !(d->rb & CGT_SPU_FEATURE_PREFETCH)))
CGT_SPU_ROW(hbra, LBT,   0x080, LS, NONE,      HINT((uint32_t)imm, 1))
CGT_SPU_ROW(hbrr, LBT,   0x090, LS, NONE,      HINT(pc + (uint32_t)imm, 1))
