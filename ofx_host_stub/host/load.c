/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "catalogue.h"

#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>

/* One plugin of a binary, for all hosts. Many libraries free the struct in Unload and make another
   one when they are asked again: the pointer is good from OfxGetPlugin to Unload. */
typedef struct loaded {
    OfxPlugin *plugin;           /* NULL = to be fetched */
    unsigned loads;              /* hosts that want it loaded */
    pthread_mutex_t render_lock; /* for plugins that render only once at a time */
    bool has_lock;
} loaded;

/* A binary is mapped, and its plugins are loaded, once in a process, whatever the number of hosts.
 */
struct wo_module {
    wo_module *next;
    char *path; /* real, absolute */
    void *library;
    OfxPlugin *(*get)(int nth);
    unsigned users;
    int count;
    loaded *plugins;
};

static struct {
    pthread_mutex_t describing; /* one plugin of the process at a time; taken before lock */
    pthread_mutex_t lock;
    wo_module *first;
} modules = {.describing = PTHREAD_MUTEX_INITIALIZER, .lock = PTHREAD_MUTEX_INITIALIZER};

typedef union symbol {
    void *address;
    OfxStatus (*set_host)(const OfxHost *host);
    int (*count)(void);
    OfxPlugin *(*get)(int nth);
} symbol;

static void module_free(wo_module *module)
{
    for (int i = 0; module->plugins && i < module->count; i++)
        if (module->plugins[i].has_lock)
            pthread_mutex_destroy(&module->plugins[i].render_lock);
    if (module->library)
        dlclose(module->library);
    free(module->plugins);
    free(module->path);
    free(module);
}

/* A binary stays mapped to the end of the process: threads that it has started, those of OpenMP
   among them, may still be in its code after Unload. */
#ifdef RTLD_NODELETE
#define MAP_FLAGS (RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE)
#else
#define MAP_FLAGS (RTLD_NOW | RTLD_LOCAL)
#endif

/* Maps a binary and asks how many plugins it has; NULL with the reason in *why. */
static wo_module *module_map(char *path, const char **why)
{
    wo_module *module = calloc(1, sizeof *module);
    if (!module) {
        free(path);
        *why = "out of memory";
        return NULL;
    }
    module->path = path;
    *why = wo_binary_fault(path);
    if (*why) {
        module_free(module);
        return NULL;
    }
    module->library = dlopen(path, MAP_FLAGS);
    if (!module->library) {
        const char *text = dlerror();
        *why = text ? text : "cannot be opened";
        module_free(module);
        return NULL;
    }
    const symbol set_host = {.address = dlsym(module->library, "OfxSetHost")};
    const symbol count = {.address = dlsym(module->library, "OfxGetNumberOfPlugins")};
    const symbol get = {.address = dlsym(module->library, "OfxGetPlugin")};
    if (!count.address || !get.address) {
        *why = count.address ? "it exports no OfxGetPlugin" : "it exports no OfxGetNumberOfPlugins";
        module_free(module);
        return NULL;
    }
    if (set_host.address && set_host.set_host(wo_process_ofx_host()) == kOfxStatFailed) {
        *why = "it does not want this host";
        module_free(module);
        return NULL;
    }
    const int plugins = count.count();
    if (plugins < 1 || plugins > WO_BINARY_PLUGINS_MAX) {
        *why = plugins < 1 ? "it says it has no plugins" : "it says it has too many plugins";
        module_free(module);
        return NULL;
    }
    module->plugins = calloc((size_t)plugins, sizeof *module->plugins);
    if (!module->plugins) {
        *why = "out of memory";
        module_free(module);
        return NULL;
    }
    module->count = plugins;
    module->get = get.get;
    for (int i = 0; i < plugins; i++)
        module->plugins[i].has_lock =
            pthread_mutex_init(&module->plugins[i].render_lock, NULL) == 0;
    return module;
}

wo_module *wo_module_open(const wo_binary *binary, const char **why)
{
    char *path = realpath(binary->path, NULL);
    if (!path) {
        *why = "it has no absolute path";
        return NULL;
    }
    pthread_mutex_lock(&modules.lock);
    wo_module *module = modules.first;
    while (module && strcmp(module->path, path) != 0)
        module = module->next;
    if (module) {
        free(path);
    } else {
        wo_surroundings before;
        wo_surroundings_enter(&before);
        module = module_map(path, why);
        wo_surroundings_leave(&before);
        if (module) {
            module->next = modules.first;
            modules.first = module;
        }
    }
    if (module)
        module->users++;
    pthread_mutex_unlock(&modules.lock);
    return module;
}

void wo_module_close(wo_module **place)
{
    wo_module *module = *place;
    pthread_mutex_lock(&modules.lock);
    if (module && --module->users == 0) {
        wo_module **link = &modules.first;
        while (*link != module)
            link = &(*link)->next;
        *link = module->next;
        module_free(module);
    }
    pthread_mutex_unlock(&modules.lock);
    *place = NULL;
}

int wo_module_count(const wo_module *module)
{
    return module->count;
}

/* Why plugin `index` of a binary is none for us, NULL when it is one. Fetches it if need be; the
   lock is held. */
static const char *unfit(wo_module *module, int index)
{
    loaded *it = &module->plugins[index];
    if (!it->plugin) {
        wo_surroundings before;
        wo_surroundings_enter(&before);
        it->plugin = module->get(index);
        wo_surroundings_leave(&before);
    }
    const OfxPlugin *plugin = it->plugin;
    if (!plugin)
        return "is NULL";
    if (!it->has_lock)
        return "has no lock";
    if (!plugin->pluginApi || strcmp(plugin->pluginApi, kOfxImageEffectPluginApi) != 0)
        return "is no image effect";
    if (plugin->apiVersion != kOfxImageEffectPluginApiVersion)
        return "is for another version of the API";
    if (!plugin->pluginIdentifier || !*plugin->pluginIdentifier)
        return "has no identifier";
    if (!plugin->setHost || !plugin->mainEntry)
        return "lacks a function";
    return NULL;
}

/* A plugin of another interface is none of ours, but nothing is wrong with it. */
static bool is_foreign(const OfxPlugin *plugin)
{
    return plugin && plugin->pluginApi &&
           (strcmp(plugin->pluginApi, kOfxImageEffectPluginApi) != 0 ||
            plugin->apiVersion != kOfxImageEffectPluginApiVersion);
}

/* Is what the binary gives now the plugin this entry was made for? */
static bool same_plugin(const wo_entry *entry, const OfxPlugin *plugin)
{
    return strcmp(plugin->pluginIdentifier, entry->identifier) == 0 &&
           plugin->pluginVersionMajor == entry->info.version_major &&
           plugin->pluginVersionMinor == entry->info.version_minor;
}

OfxStatus wo_entry_load(wo_entry *entry)
{
    OfxStatus status = kOfxStatOK;
    loaded *it = &entry->module->plugins[entry->index];
    if (entry->loaded)
        return kOfxStatOK;
    pthread_mutex_lock(&modules.lock);
    if (unfit(entry->module, entry->index) || !same_plugin(entry, it->plugin)) {
        wo_note_failure(entry->host, "%s: plugin %d is no longer %s", entry->bundle, entry->index,
                        entry->identifier);
        status = kOfxStatFailed;
    }
    entry->plugin = it->plugin;
    if (status == kOfxStatOK && it->loads == 0) {
        wo_frame frame = {.action = WO_ACTION_LOAD};
        wo_surroundings before;
        wo_surroundings_enter(&before);
        it->plugin->setHost(wo_process_ofx_host());
        wo_surroundings_leave(&before);
        status = wo_act(entry, &frame, NULL, NULL);
    }
    if (status == kOfxStatOK || status == kOfxStatReplyDefault) {
        it->loads++;
        entry->loaded = true;
        status = kOfxStatOK;
    }
    pthread_mutex_unlock(&modules.lock);
    return status;
}

void wo_entry_unload(wo_entry *entry)
{
    loaded *it = &entry->module->plugins[entry->index];
    if (!entry->loaded)
        return;
    pthread_mutex_lock(&modules.lock);
    entry->loaded = false;
    if (--it->loads == 0) {
        wo_frame frame = {.action = WO_ACTION_UNLOAD};
        (void)wo_act(entry, &frame, NULL, NULL);
        wo_frame_set(&frame);
        wo_memory_check_left(entry->plugin, NULL);
        wo_mutexes_check_left(entry->plugin);
        wo_frame_set(frame.outer);
        it->plugin = NULL;
    }
    pthread_mutex_unlock(&modules.lock);
}

pthread_mutex_t *wo_entry_render_lock(wo_entry *entry)
{
    return &entry->module->plugins[entry->index].render_lock;
}

void wo_entry_destroy(wo_entry **place)
{
    wo_entry *entry = *place;
    if (!entry)
        return;
    wo_entry_forget(entry);
    wo_entry_unload(entry);
    wo_module_close(&entry->module);
    free(entry->identifier);
    free(entry->bundle);
    free(entry->binary);
    free(entry);
    *place = NULL;
}

static bool known(const wo_host *host, const OfxPlugin *plugin)
{
    for (size_t i = 0; i < host->entry_count; i++) {
        const wo_host_plugin *other = &host->entries[i]->info;
        if (strcmp(other->identifier, plugin->pluginIdentifier) == 0 &&
            other->version_major == plugin->pluginVersionMajor &&
            other->version_minor >= plugin->pluginVersionMinor)
            return true;
    }
    return false;
}

const char *wo_module_identifier(wo_module *module, int index)
{
    pthread_mutex_lock(&modules.lock);
    const bool fit = unfit(module, index) == NULL;
    pthread_mutex_unlock(&modules.lock);
    return fit ? module->plugins[index].plugin->pluginIdentifier : NULL;
}

static wo_entry *entry_new(wo_host *host, const wo_binary *binary, wo_module *module, int index)
{
    const OfxPlugin *plugin = module->plugins[index].plugin;
    wo_entry *entry = calloc(1, sizeof *entry);
    if (!entry)
        return NULL;
    entry->host = host;
    entry->module = module;
    entry->index = index;
    pthread_mutex_lock(&modules.lock);
    module->users++;
    pthread_mutex_unlock(&modules.lock);
    entry->info.identifier = entry->identifier = wo_text_copy(plugin->pluginIdentifier);
    entry->info.version_major = plugin->pluginVersionMajor;
    entry->info.version_minor = plugin->pluginVersionMinor;
    entry->info.internal = entry;
    entry->info.bundle = entry->bundle = wo_text_copy(binary->bundle);
    entry->info.binary = entry->binary = wo_text_copy(binary->path);
    if (!entry->identifier || !entry->bundle || !entry->binary)
        wo_entry_destroy(&entry);
    return entry;
}

/* Adds a described entry to the host and to its binary's catalogue. */
static bool keep(wo_host *host, wo_binary *binary, wo_entry *entry, size_t breaches)
{
    wo_entry **entries =
        wo_grow(host->entries, host->entry_count, &host->entry_capacity, sizeof *host->entries);
    if (entries)
        host->entries = entries;
    const size_t now = wo_host_violation_count(host);
    const char *first = wo_own_violation(entry, breaches);
    if (!entries || !wo_catalogue_take(binary, entry, now - breaches, first ? first : ""))
        return false;
    host->entries[host->entry_count++] = entry;
    return true;
}

wo_entry *wo_module_describe(wo_host *host, wo_binary *binary, wo_module *module, int index)
{
    const size_t breaches = wo_host_violation_count(host);
    wo_entry *entry = NULL;
    pthread_mutex_lock(&modules.describing);
    pthread_mutex_lock(&modules.lock);
    const char *why = unfit(module, index);
    pthread_mutex_unlock(&modules.lock);
    if (why && is_foreign(module->plugins[index].plugin))
        wo_note(host, "%s: plugin %d %s", binary->bundle, index, why);
    else if (why)
        wo_note_failure(host, "%s: plugin %d %s", binary->bundle, index, why);
    else if (known(host, module->plugins[index].plugin))
        wo_note(host, "%s: %s was found before", binary->bundle,
                module->plugins[index].plugin->pluginIdentifier);
    else if (!(entry = entry_new(host, binary, module, index)))
        wo_note(host, "%s: out of memory", binary->bundle);
    if (entry && !wo_entry_describe(entry)) {
        wo_entry_destroy(&entry);
    } else if (entry && !keep(host, binary, entry, breaches)) {
        wo_note(host, "%s: out of memory", binary->bundle);
        wo_entry_destroy(&entry);
    }
    pthread_mutex_unlock(&modules.describing);
    return entry;
}
