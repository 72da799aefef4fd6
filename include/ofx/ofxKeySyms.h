/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/*
 * Keys for interacts. The numbers are those of the X11 key symbols; a symbol of ASCII or Latin 1 is
 * its own code. Keys that produce text no symbol covers come as kOfxKey_Unknown with the text in
 * kOfxPropKeyString.
 */

#ifndef WO_OFX_KEY_SYMS_H
#define WO_OFX_KEY_SYMS_H

#include "ofxCore.h"

/* int: one of the symbols below. The string begins with a k. */
#define kOfxPropKeySym "kOfxPropKeySym"

/* string: UTF-8 text the key makes, if any. The string begins with a k. */
#define kOfxPropKeyString "kOfxPropKeyString"

#define kOfxKey_Unknown 0x0000

/* ---- Editing and control --------------------------------------------------------------------- */

#define kOfxKey_BackSpace   0xFF08
#define kOfxKey_Tab         0xFF09
#define kOfxKey_Linefeed    0xFF0A
#define kOfxKey_Clear       0xFF0B
#define kOfxKey_Return      0xFF0D
#define kOfxKey_Pause       0xFF13
#define kOfxKey_Scroll_Lock 0xFF14
#define kOfxKey_Sys_Req     0xFF15
#define kOfxKey_Escape      0xFF1B
#define kOfxKey_Delete      0xFFFF

/* ---- Cursor ---------------------------------------------------------------------------------- */

#define kOfxKey_Home      0xFF50
#define kOfxKey_Left      0xFF51
#define kOfxKey_Up        0xFF52
#define kOfxKey_Right     0xFF53
#define kOfxKey_Down      0xFF54
#define kOfxKey_Prior     0xFF55
#define kOfxKey_Page_Up   0xFF55
#define kOfxKey_Next      0xFF56
#define kOfxKey_Page_Down 0xFF56
#define kOfxKey_End       0xFF57
#define kOfxKey_Begin     0xFF58

/* ---- Functions ------------------------------------------------------------------------------- */

#define kOfxKey_Select        0xFF60
#define kOfxKey_Print         0xFF61
#define kOfxKey_Execute       0xFF62
#define kOfxKey_Insert        0xFF63
#define kOfxKey_Undo          0xFF65
#define kOfxKey_Redo          0xFF66
#define kOfxKey_Menu          0xFF67
#define kOfxKey_Find          0xFF68
#define kOfxKey_Cancel        0xFF69
#define kOfxKey_Help          0xFF6A
#define kOfxKey_Break         0xFF6B
#define kOfxKey_Mode_switch   0xFF7E
#define kOfxKey_script_switch 0xFF7E
#define kOfxKey_Num_Lock      0xFF7F

/* ---- Number pad ------------------------------------------------------------------------------ */

#define kOfxKey_KP_Space 0xFF80
#define kOfxKey_KP_Tab   0xFF89
#define kOfxKey_KP_Enter 0xFF8D
#define kOfxKey_KP_F1    0xFF91
#define kOfxKey_KP_F2    0xFF92
#define kOfxKey_KP_F3    0xFF93
#define kOfxKey_KP_F4    0xFF94

#define kOfxKey_KP_Home      0xFF95
#define kOfxKey_KP_Left      0xFF96
#define kOfxKey_KP_Up        0xFF97
#define kOfxKey_KP_Right     0xFF98
#define kOfxKey_KP_Down      0xFF99
#define kOfxKey_KP_Prior     0xFF9A
#define kOfxKey_KP_Page_Up   0xFF9A
#define kOfxKey_KP_Next      0xFF9B
#define kOfxKey_KP_Page_Down 0xFF9B
#define kOfxKey_KP_End       0xFF9C
#define kOfxKey_KP_Begin     0xFF9D
#define kOfxKey_KP_Insert    0xFF9E
#define kOfxKey_KP_Delete    0xFF9F

#define kOfxKey_KP_Equal     0xFFBD
#define kOfxKey_KP_Multiply  0xFFAA
#define kOfxKey_KP_Add       0xFFAB
#define kOfxKey_KP_Separator 0xFFAC
#define kOfxKey_KP_Subtract  0xFFAD
#define kOfxKey_KP_Decimal   0xFFAE
#define kOfxKey_KP_Divide    0xFFAF

#define kOfxKey_KP_0 0xFFB0
#define kOfxKey_KP_1 0xFFB1
#define kOfxKey_KP_2 0xFFB2
#define kOfxKey_KP_3 0xFFB3
#define kOfxKey_KP_4 0xFFB4
#define kOfxKey_KP_5 0xFFB5
#define kOfxKey_KP_6 0xFFB6
#define kOfxKey_KP_7 0xFFB7
#define kOfxKey_KP_8 0xFFB8
#define kOfxKey_KP_9 0xFFB9

/* ---- Function keys --------------------------------------------------------------------------- */

#define kOfxKey_F1  0xFFBE
#define kOfxKey_F2  0xFFBF
#define kOfxKey_F3  0xFFC0
#define kOfxKey_F4  0xFFC1
#define kOfxKey_F5  0xFFC2
#define kOfxKey_F6  0xFFC3
#define kOfxKey_F7  0xFFC4
#define kOfxKey_F8  0xFFC5
#define kOfxKey_F9  0xFFC6
#define kOfxKey_F10 0xFFC7
#define kOfxKey_F11 0xFFC8
#define kOfxKey_F12 0xFFC9
#define kOfxKey_F13 0xFFCA
#define kOfxKey_F14 0xFFCB
#define kOfxKey_F15 0xFFCC
#define kOfxKey_F16 0xFFCD
#define kOfxKey_F17 0xFFCE
#define kOfxKey_F18 0xFFCF
#define kOfxKey_F19 0xFFD0
#define kOfxKey_F20 0xFFD1
#define kOfxKey_F21 0xFFD2
#define kOfxKey_F22 0xFFD3
#define kOfxKey_F23 0xFFD4
#define kOfxKey_F24 0xFFD5
#define kOfxKey_F25 0xFFD6
#define kOfxKey_F26 0xFFD7
#define kOfxKey_F27 0xFFD8
#define kOfxKey_F28 0xFFD9
#define kOfxKey_F29 0xFFDA
#define kOfxKey_F30 0xFFDB
#define kOfxKey_F31 0xFFDC
#define kOfxKey_F32 0xFFDD
#define kOfxKey_F33 0xFFDE
#define kOfxKey_F34 0xFFDF
#define kOfxKey_F35 0xFFE0

#define kOfxKey_L1  0xFFC8
#define kOfxKey_L2  0xFFC9
#define kOfxKey_L3  0xFFCA
#define kOfxKey_L4  0xFFCB
#define kOfxKey_L5  0xFFCC
#define kOfxKey_L6  0xFFCD
#define kOfxKey_L7  0xFFCE
#define kOfxKey_L8  0xFFCF
#define kOfxKey_L9  0xFFD0
#define kOfxKey_L10 0xFFD1

#define kOfxKey_R1  0xFFD2
#define kOfxKey_R2  0xFFD3
#define kOfxKey_R3  0xFFD4
#define kOfxKey_R4  0xFFD5
#define kOfxKey_R5  0xFFD6
#define kOfxKey_R6  0xFFD7
#define kOfxKey_R7  0xFFD8
#define kOfxKey_R8  0xFFD9
#define kOfxKey_R9  0xFFDA
#define kOfxKey_R10 0xFFDB
#define kOfxKey_R11 0xFFDC
#define kOfxKey_R12 0xFFDD
#define kOfxKey_R13 0xFFDE
#define kOfxKey_R14 0xFFDF
#define kOfxKey_R15 0xFFE0

/* ---- Modifiers ------------------------------------------------------------------------------- */

#define kOfxKey_Shift_L    0xFFE1
#define kOfxKey_Shift_R    0xFFE2
#define kOfxKey_Control_L  0xFFE3
#define kOfxKey_Control_R  0xFFE4
#define kOfxKey_Caps_Lock  0xFFE5
#define kOfxKey_Shift_Lock 0xFFE6
#define kOfxKey_Meta_L     0xFFE7
#define kOfxKey_Meta_R     0xFFE8
#define kOfxKey_Alt_L      0xFFE9
#define kOfxKey_Alt_R      0xFFEA
#define kOfxKey_Super_L    0xFFEB
#define kOfxKey_Super_R    0xFFEC
#define kOfxKey_Hyper_L    0xFFED
#define kOfxKey_Hyper_R    0xFFEE

/* ---- Input methods --------------------------------------------------------------------------- */

#define kOfxKey_Multi_key         0xFF20
#define kOfxKey_SingleCandidate   0xFF3C
#define kOfxKey_MultipleCandidate 0xFF3D
#define kOfxKey_PreviousCandidate 0xFF3E

#define kOfxKey_Kanji             0xFF21
#define kOfxKey_Muhenkan          0xFF22
#define kOfxKey_Henkan_Mode       0xFF23
#define kOfxKey_Henkan            0xFF23
#define kOfxKey_Romaji            0xFF24
#define kOfxKey_Hiragana          0xFF25
#define kOfxKey_Katakana          0xFF26
#define kOfxKey_Hiragana_Katakana 0xFF27
#define kOfxKey_Zenkaku           0xFF28
#define kOfxKey_Hankaku           0xFF29
#define kOfxKey_Zenkaku_Hankaku   0xFF2A
#define kOfxKey_Touroku           0xFF2B
#define kOfxKey_Massyo            0xFF2C
#define kOfxKey_Kana_Lock         0xFF2D
#define kOfxKey_Kana_Shift        0xFF2E
#define kOfxKey_Eisu_Shift        0xFF2F
#define kOfxKey_Eisu_toggle       0xFF30
#define kOfxKey_Zen_Koho          0xFF3D
#define kOfxKey_Mae_Koho          0xFF3E

/* ---- ASCII ----------------------------------------------------------------------------------- */

#define kOfxKey_space        0x20
#define kOfxKey_exclam       0x21
#define kOfxKey_quotedbl     0x22
#define kOfxKey_numbersign   0x23
#define kOfxKey_dollar       0x24
#define kOfxKey_percent      0x25
#define kOfxKey_ampersand    0x26
#define kOfxKey_apostrophe   0x27
#define kOfxKey_quoteright   0x27
#define kOfxKey_parenleft    0x28
#define kOfxKey_parenright   0x29
#define kOfxKey_asterisk     0x2A
#define kOfxKey_plus         0x2B
#define kOfxKey_comma        0x2C
#define kOfxKey_minus        0x2D
#define kOfxKey_period       0x2E
#define kOfxKey_slash        0x2F
#define kOfxKey_colon        0x3A
#define kOfxKey_semicolon    0x3B
#define kOfxKey_less         0x3C
#define kOfxKey_equal        0x3D
#define kOfxKey_greater      0x3E
#define kOfxKey_question     0x3F
#define kOfxKey_at           0x40
#define kOfxKey_bracketleft  0x5B
#define kOfxKey_backslash    0x5C
#define kOfxKey_bracketright 0x5D
#define kOfxKey_asciicircum  0x5E
#define kOfxKey_underscore   0x5F
#define kOfxKey_grave        0x60
#define kOfxKey_quoteleft    0x60
#define kOfxKey_braceleft    0x7B
#define kOfxKey_bar          0x7C
#define kOfxKey_braceright   0x7D
#define kOfxKey_asciitilde   0x7E

#define kOfxKey_0 0x30
#define kOfxKey_1 0x31
#define kOfxKey_2 0x32
#define kOfxKey_3 0x33
#define kOfxKey_4 0x34
#define kOfxKey_5 0x35
#define kOfxKey_6 0x36
#define kOfxKey_7 0x37
#define kOfxKey_8 0x38
#define kOfxKey_9 0x39

#define kOfxKey_A 0x41
#define kOfxKey_B 0x42
#define kOfxKey_C 0x43
#define kOfxKey_D 0x44
#define kOfxKey_E 0x45
#define kOfxKey_F 0x46
#define kOfxKey_G 0x47
#define kOfxKey_H 0x48
#define kOfxKey_I 0x49
#define kOfxKey_J 0x4A
#define kOfxKey_K 0x4B
#define kOfxKey_L 0x4C
#define kOfxKey_M 0x4D
#define kOfxKey_N 0x4E
#define kOfxKey_O 0x4F
#define kOfxKey_P 0x50
#define kOfxKey_Q 0x51
#define kOfxKey_R 0x52
#define kOfxKey_S 0x53
#define kOfxKey_T 0x54
#define kOfxKey_U 0x55
#define kOfxKey_V 0x56
#define kOfxKey_W 0x57
#define kOfxKey_X 0x58
#define kOfxKey_Y 0x59
#define kOfxKey_Z 0x5A

#define kOfxKey_a 0x61
#define kOfxKey_b 0x62
#define kOfxKey_c 0x63
#define kOfxKey_d 0x64
#define kOfxKey_e 0x65
#define kOfxKey_f 0x66
#define kOfxKey_g 0x67
#define kOfxKey_h 0x68
#define kOfxKey_i 0x69
#define kOfxKey_j 0x6A
#define kOfxKey_k 0x6B
#define kOfxKey_l 0x6C
#define kOfxKey_m 0x6D
#define kOfxKey_n 0x6E
#define kOfxKey_o 0x6F
#define kOfxKey_p 0x70
#define kOfxKey_q 0x71
#define kOfxKey_r 0x72
#define kOfxKey_s 0x73
#define kOfxKey_t 0x74
#define kOfxKey_u 0x75
#define kOfxKey_v 0x76
#define kOfxKey_w 0x77
#define kOfxKey_x 0x78
#define kOfxKey_y 0x79
#define kOfxKey_z 0x7A

/* ---- Latin 1 --------------------------------------------------------------------------------- */

#define kOfxKey_nobreakspace   0xA0
#define kOfxKey_exclamdown     0xA1
#define kOfxKey_cent           0xA2
#define kOfxKey_sterling       0xA3
#define kOfxKey_currency       0xA4
#define kOfxKey_yen            0xA5
#define kOfxKey_brokenbar      0xA6
#define kOfxKey_section        0xA7
#define kOfxKey_diaeresis      0xA8
#define kOfxKey_copyright      0xA9
#define kOfxKey_ordfeminine    0xAA
#define kOfxKey_guillemotleft  0xAB
#define kOfxKey_notsign        0xAC
#define kOfxKey_hyphen         0xAD
#define kOfxKey_registered     0xAE
#define kOfxKey_macron         0xAF
#define kOfxKey_degree         0xB0
#define kOfxKey_plusminus      0xB1
#define kOfxKey_twosuperior    0xB2
#define kOfxKey_threesuperior  0xB3
#define kOfxKey_acute          0xB4
#define kOfxKey_mu             0xB5
#define kOfxKey_paragraph      0xB6
#define kOfxKey_periodcentered 0xB7
#define kOfxKey_cedilla        0xB8
#define kOfxKey_onesuperior    0xB9
#define kOfxKey_masculine      0xBA
#define kOfxKey_guillemotright 0xBB
#define kOfxKey_onequarter     0xBC
#define kOfxKey_onehalf        0xBD
#define kOfxKey_threequarters  0xBE
#define kOfxKey_questiondown   0xBF

#define kOfxKey_Agrave      0xC0
#define kOfxKey_Aacute      0xC1
#define kOfxKey_Acircumflex 0xC2
#define kOfxKey_Atilde      0xC3
#define kOfxKey_Adiaeresis  0xC4
#define kOfxKey_Aring       0xC5
#define kOfxKey_AE          0xC6
#define kOfxKey_Ccedilla    0xC7
#define kOfxKey_Egrave      0xC8
#define kOfxKey_Eacute      0xC9
#define kOfxKey_Ecircumflex 0xCA
#define kOfxKey_Ediaeresis  0xCB
#define kOfxKey_Igrave      0xCC
#define kOfxKey_Iacute      0xCD
#define kOfxKey_Icircumflex 0xCE
#define kOfxKey_Idiaeresis  0xCF
#define kOfxKey_ETH         0xD0
#define kOfxKey_Eth         0xD0
#define kOfxKey_Ntilde      0xD1
#define kOfxKey_Ograve      0xD2
#define kOfxKey_Oacute      0xD3
#define kOfxKey_Ocircumflex 0xD4
#define kOfxKey_Otilde      0xD5
#define kOfxKey_Odiaeresis  0xD6
#define kOfxKey_multiply    0xD7
#define kOfxKey_Ooblique    0xD8
#define kOfxKey_Oslash      0xD8
#define kOfxKey_Ugrave      0xD9
#define kOfxKey_Uacute      0xDA
#define kOfxKey_Ucircumflex 0xDB
#define kOfxKey_Udiaeresis  0xDC
#define kOfxKey_Yacute      0xDD
#define kOfxKey_THORN       0xDE
#define kOfxKey_Thorn       0xDE

#define kOfxKey_ssharp      0xDF
#define kOfxKey_agrave      0xE0
#define kOfxKey_aacute      0xE1
#define kOfxKey_acircumflex 0xE2
#define kOfxKey_atilde      0xE3
#define kOfxKey_adiaeresis  0xE4
#define kOfxKey_aring       0xE5
#define kOfxKey_ae          0xE6
#define kOfxKey_ccedilla    0xE7
#define kOfxKey_egrave      0xE8
#define kOfxKey_eacute      0xE9
#define kOfxKey_ecircumflex 0xEA
#define kOfxKey_ediaeresis  0xEB
#define kOfxKey_igrave      0xEC
#define kOfxKey_iacute      0xED
#define kOfxKey_icircumflex 0xEE
#define kOfxKey_idiaeresis  0xEF
#define kOfxKey_eth         0xF0
#define kOfxKey_ntilde      0xF1
#define kOfxKey_ograve      0xF2
#define kOfxKey_oacute      0xF3
#define kOfxKey_ocircumflex 0xF4
#define kOfxKey_otilde      0xF5
#define kOfxKey_odiaeresis  0xF6
#define kOfxKey_division    0xF7
#define kOfxKey_oslash      0xF8
#define kOfxKey_ooblique    0xF8
#define kOfxKey_ugrave      0xF9
#define kOfxKey_uacute      0xFA
#define kOfxKey_ucircumflex 0xFB
#define kOfxKey_udiaeresis  0xFC
#define kOfxKey_yacute      0xFD
#define kOfxKey_thorn       0xFE
#define kOfxKey_ydiaeresis  0xFF

#endif
