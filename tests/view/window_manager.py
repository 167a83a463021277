"""A window manager that does nothing but place windows at the top left, minimize and restore them, as ICCCM 4.1
says: by libX11 alone. Prints a line when it is ready, and ends with the display."""

import ctypes
import os
import sys

X = ctypes.CDLL("libX11.so.6")
Window = Atom = ctypes.c_ulong


class Message(ctypes.Structure):
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int),
                ("display", ctypes.c_void_p), ("window", Window), ("message_type", Atom), ("format", ctypes.c_int),
                ("data", ctypes.c_long * 5)]


class Request(ctypes.Structure):  # to map or to configure
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int),
                ("display", ctypes.c_void_p), ("parent", Window), ("window", Window), ("x", ctypes.c_int),
                ("y", ctypes.c_int), ("width", ctypes.c_int), ("height", ctypes.c_int), ("border_width", ctypes.c_int),
                ("above", Window), ("detail", ctypes.c_int), ("value_mask", ctypes.c_ulong)]


class Event(ctypes.Union):
    _fields_ = [("type", ctypes.c_int), ("message", Message), ("request", Request), ("pad", ctypes.c_long * 24)]


class Changes(ctypes.Structure):
    _fields_ = [("x", ctypes.c_int), ("y", ctypes.c_int), ("width", ctypes.c_int), ("height", ctypes.c_int),
                ("border_width", ctypes.c_int), ("sibling", Window), ("stack_mode", ctypes.c_int)]


MAP_REQUEST, CONFIGURE_REQUEST, CLIENT_MESSAGE = 20, 23, 33
STRUCTURE_REDIRECT = 1 << 20
STRUCTURE_NOTIFY = 1 << 19
WITHDRAWN, NORMAL, ICONIC = 0, 1, 3
PLACE = 3  # bits of x and y in a mask of changes

X.XOpenDisplay.restype = ctypes.c_void_p
X.XDefaultRootWindow.restype = Window
X.XDefaultRootWindow.argtypes = [ctypes.c_void_p]
X.XInternAtom.restype = Atom
X.XInternAtom.argtypes = [ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int]
X.XSelectInput.argtypes = [ctypes.c_void_p, Window, ctypes.c_long]
X.XSync.argtypes = [ctypes.c_void_p, ctypes.c_int]
X.XNextEvent.argtypes = [ctypes.c_void_p, ctypes.POINTER(Event)]
X.XMapWindow.argtypes = X.XUnmapWindow.argtypes = [ctypes.c_void_p, Window]
X.XSetInputFocus.argtypes = [ctypes.c_void_p, Window, ctypes.c_int, ctypes.c_ulong]
X.XConfigureWindow.argtypes = [ctypes.c_void_p, Window, ctypes.c_uint, ctypes.POINTER(Changes)]
X.XChangeProperty.argtypes = [ctypes.c_void_p, Window, Atom, Atom, ctypes.c_int, ctypes.c_int, ctypes.c_char_p,
                              ctypes.c_int]

# A window may be gone when it is asked for something; and the display when the tests are over.
ERROR = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_void_p)
gone = ERROR(lambda *_: 0)
over = ERROR(lambda *_: os._exit(0))
X.XSetErrorHandler(gone)
X.XSetIOErrorHandler(over)

display = X.XOpenDisplay(None)
if not display:
    sys.exit("no display")
root = X.XDefaultRootWindow(display)
wm_state = X.XInternAtom(display, b"WM_STATE", 0)
wm_change_state = X.XInternAtom(display, b"WM_CHANGE_STATE", 0)


def set_state(window, state):
    data = (ctypes.c_long * 2)(state, 0)
    X.XChangeProperty(display, window, wm_state, wm_state, 32, 0, ctypes.cast(data, ctypes.c_char_p), 2)


X.XSelectInput(display, root, STRUCTURE_REDIRECT | STRUCTURE_NOTIFY)
X.XSync(display, 0)
print("ready", flush=True)
event = Event()
while True:
    X.XNextEvent(display, ctypes.byref(event))
    if event.type == MAP_REQUEST:
        window = event.request.window
        X.XConfigureWindow(display, window, PLACE, ctypes.byref(Changes()))
        set_state(window, NORMAL)
        X.XMapWindow(display, window)
        X.XSync(display, 0)
        X.XSetInputFocus(display, window, 1, 0)
    elif event.type == CONFIGURE_REQUEST:
        asked = event.request
        changes = Changes(0, 0, asked.width, asked.height, asked.border_width, asked.above, asked.detail)
        X.XConfigureWindow(display, asked.window, asked.value_mask, ctypes.byref(changes))
    elif event.type == CLIENT_MESSAGE and event.message.message_type == wm_change_state:
        if event.message.data[0] == ICONIC:
            set_state(event.message.window, ICONIC)
            X.XUnmapWindow(display, event.message.window)
